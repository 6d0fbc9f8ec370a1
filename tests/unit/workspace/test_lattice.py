"""The graph of lattice states."""

import math

import numpy as np
import pytest

from tlcomm_core.workspace.grid import HEADING_STEPS, Grid
from tlcomm_core.workspace.lattice import HEADINGS, HEADINGS_RAD, Lattice


def test_headings_point_along_their_steps() -> None:
    """Heading k is the direction of step k, in (-π, π]."""
    for (dx, dy), heading_rad in zip(HEADING_STEPS, HEADINGS_RAD, strict=True):
        assert heading_rad == pytest.approx(math.atan2(dy, dx), abs=1e-15)


def test_paths_into_a_location_begin_at_every_heading_and_end_at_any() -> None:
    """On one cell all states are the goal; on two, only turns and one straight count."""
    tree = Lattice(Grid((1.0, 0.5), 0.5), 2.0, 0.5).paths_into(1)
    assert tree.time_s.tolist() == [1, 3, 5, 7, 9, 7, 5, 3, 0, 0, 0, 0, 0, 0, 0, 0]


def test_paths_out_begin_with_the_time_spent_at_each_heading() -> None:
    """The search out of a place starts from given times, infinite ones excluded."""
    start_s = (10.0, *[math.inf] * (HEADINGS - 2), 3.0)
    tree = Lattice(Grid((1.0, 0.5), 0.5), 2.0, 0.5).paths_out_of(0, start_s)
    assert tree.time_s[:HEADINGS].tolist() == [5, 7, 9, 11, 9, 7, 5, 3]
    assert tree.time_s[HEADINGS] == 6.0


def test_unreachable_states_have_infinite_time_and_no_next_node() -> None:
    """Across a wall there is no path."""
    tree = Lattice(Grid((1.5, 0.5), 0.5, [(0.5, 0.0, 1.0, 0.5)]), 1.0, 1.0).paths_into(0)
    assert np.isinf(tree.time_s[HEADINGS:]).all()
    assert (tree.next_node[HEADINGS:] < 0).all()
