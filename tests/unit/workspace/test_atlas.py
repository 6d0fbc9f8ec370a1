"""Travel times by motion and avoided regions."""

import gc
import weakref

import numpy as np
import pytest

from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.travel import Motion

ATLAS = Atlas(Grid((2.5, 0.5), 0.5), {"gate": (1.25, 0.25, 0.2), "end": (2.25, 0.1, 0.2)})
MOTION = Motion(1.0, 1.5)


def test_equal_motions_that_avoid_the_same_share_their_travel_times() -> None:
    """Another motion or another region gives others."""
    plain = ATLAS.travel(MOTION)
    round_gate = ATLAS.travel(MOTION, frozenset({"gate"}))
    assert ATLAS.travel(Motion(1.0, 1.5)) is plain
    assert ATLAS.travel(MOTION, frozenset({"gate"})) is round_gate is not plain
    assert ATLAS.travel(Motion(2.0, 1.5)) is not plain
    assert ATLAS.travel(MOTION, frozenset({"end"})).grid.avoided.keys() == {"end"}


def test_what_is_avoided_is_out_of_reach_and_so_is_what_lies_behind() -> None:
    """All others keep their times."""
    plain, round_gate = ATLAS.travel(MOTION), ATLAS.travel(MOTION, frozenset({"gate"}))
    assert np.isinf(round_gate.time_to(0)[2:]).all()
    np.testing.assert_array_equal(round_gate.time_to(0)[:2], plain.time_to(0)[:2])


def test_only_regions_can_be_avoided() -> None:
    """Whether a peer's names are regions can be asked."""
    assert ATLAS.knows(frozenset({"gate", "end"}))
    assert not ATLAS.knows(frozenset({"gate", "gaet"}))


@pytest.mark.parametrize("cell_m", [0.05, 0.1, 0.3, 0.5])
def test_another_map_has_the_cells_that_are_given(cell_m: float) -> None:
    """On a grid of the same shape, closed by boxes, so that what isn't free hides as well."""
    rng = np.random.default_rng(round(100 * cell_m))
    grid = Grid((12 * cell_m, 9 * cell_m), cell_m, origin_m=(-1.7, 2.3))
    atlas = Atlas(grid, {"spot": (-1.6, 2.4, 0.05)})
    free = rng.random(grid.shape) < 0.7
    other = atlas.on(free)
    np.testing.assert_array_equal(other.grid.free, free)
    assert (other.grid.origin_m, other.grid.cell_m) == (grid.origin_m, cell_m)
    assert other.knows(frozenset({"spot"}))
    assert atlas.on(free.copy()) is other
    assert other.on(grid.free) is atlas
    closed_m = grid.locations_m[~free.ravel()]
    low_m, high_m = other.grid.boxes[:, None, :2], other.grid.boxes[:, None, 2:]
    assert ((low_m < closed_m) & (closed_m < high_m)).all(axis=2).any(axis=0).all()


def test_a_map_that_nobody_uses_is_forgotten() -> None:
    """It takes memory, as long as an agent may plan a round on it and no longer."""
    atlas = Atlas(Grid((2.0, 1.0), 0.5))
    shut = np.arange(8).reshape(2, 4) < 6
    other = weakref.ref(atlas.on(shut))
    gc.collect()
    assert other() is None
