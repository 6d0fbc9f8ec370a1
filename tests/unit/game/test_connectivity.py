"""Connectivity of places."""

import numpy as np
import pytest

from tlcomm_core.game.connectivity import (
    LINK_TOLERANCE_M,
    components,
    connecting_places,
    is_connected,
    within_range,
)

LINE_M = np.array([[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [4.0, 0.0]])
NOWHERE_M = np.empty((0, 2))


def test_range_is_closed_and_forgives_rounding() -> None:
    """A distance of R, or R and half the tolerance, is a link; R and twice it is none."""
    over_m = LINK_TOLERANCE_M * np.array([0.0, 0.5, 2.0])
    places_m = np.column_stack((1.0 + over_m, np.zeros(3)))
    assert within_range(np.zeros((1, 2)), places_m, 1.0).tolist() == [[True, True, False]]


def test_components_split_a_line_at_its_gap() -> None:
    """Places 0–1 and 3–4 m on a line are two components at 1 m, one at 2 m."""
    parts = [part.tolist() for part in components(LINE_M, 1.0)]
    assert parts == [[True, True, False, False], [False, False, True, True]]
    assert len(components(LINE_M, 2.0)) == 1


def test_a_long_chain_is_one_component() -> None:
    """Connection passes through any number of links, in any order of the places."""
    chain_m = np.column_stack((np.arange(30.0), np.zeros(30)))
    shuffled_m = np.random.default_rng(1).permutation(chain_m)
    assert is_connected(shuffled_m, 1.0)
    assert not is_connected(np.delete(chain_m, 15, axis=0), 1.0)


@pytest.mark.parametrize("count", [0, 1])
def test_nobody_and_a_single_place_are_connected(count: int) -> None:
    """A graph with less than two nodes has nothing to disconnect."""
    assert is_connected(LINE_M[:count], 0.1)


def test_a_connecting_place_touches_every_component() -> None:
    """Only the middle of a gap joins both parts; at one side the team stays apart."""
    locations_m = np.array([[0.5, 0.0], [2.0, 0.0], [2.0, 0.5], [3.5, 0.0]])
    assert connecting_places(LINE_M, locations_m, 1.0).tolist() == [False, True, False, False]


def test_an_agent_alone_may_go_anywhere() -> None:
    """Without others every place keeps the team connected."""
    assert connecting_places(NOWHERE_M, LINE_M, 1.0).all()
