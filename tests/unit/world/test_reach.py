"""Who hears whom: range, and sight past obstacles."""

import numpy as np
import pytest

from tlcomm_core.workspace.grid import Grid
from tlcomm_core.world.radio import pair_indices
from tlcomm_core.world.reach import Reach

WALLED = Reach(2.0, Grid((6.0, 6.0), 0.5, [(2.0, 2.0, 3.0, 4.0)]))
PAIR = (np.array([0]), np.array([1]))


def passages_s(places: list[list[float]], velocities: list[list[float]]) -> list[float]:
    """Return when two agents' line of sight passes a corner within 10 s, ascending."""
    times_s = WALLED.corner_times_s(np.array(places), np.array(velocities), PAIR, 10.0)
    return sorted(times_s.tolist())


def test_without_walls_range_is_all() -> None:
    """Nothing hinders, and pairs at most R apart are linked."""
    places_m = np.array([[1.5, 3.0], [3.5, 3.0], [3.6, 3.0]])
    assert not Reach(2.0).is_hindered
    assert not Reach(2.0, Grid((6.0, 6.0), 0.5)).is_hindered
    assert Reach(2.0).linked(places_m).tolist() == [True, False, True]


def test_a_wall_hides_who_is_in_range() -> None:
    """Across the wall nobody is linked, beside it and on one side of it all are."""
    places_m = np.array([[1.5, 3.0], [3.5, 3.0], [1.5, 4.5], [3.4, 4.5], [5.9, 5.9]])
    linked = WALLED.linked(places_m)
    first, second = pair_indices(5)
    assert set(zip(first[linked].tolist(), second[linked].tolist(), strict=True)) == {
        (0, 2), (1, 3), (2, 3),
    }  # fmt: skip
    assert WALLED.linked(np.stack((places_m, places_m[::-1]))).sum(axis=1).tolist() == [3, 3]


def test_corners_are_passed_when_they_are_in_line() -> None:
    """Side by side along both sides of the wall, its lower corners at 2 s, the upper at 4 s."""
    found = passages_s([[1.5, 0.0], [3.5, 0.0]], [[0.0, 1.0], [0.0, 1.0]])
    assert found == pytest.approx([2.0, 2.0, 4.0, 4.0], abs=1e-6)


def test_one_drives_while_the_other_waits() -> None:
    """From (3.5, 4.5) the corner at (2, 4) is in line with the track x = 1.5 at y = 3.833."""
    found = passages_s([[1.5, 3.0], [3.5, 4.5]], [[0.0, 0.1], [0.0, 0.0]])
    assert found == pytest.approx([25.0 / 3.0], abs=1e-6)


def test_what_is_out_of_reach_is_left_out() -> None:
    """Far from any corner, at rest, or with the corner behind one of them, nothing is passed."""
    assert passages_s([[0.5, 0.2], [0.5, 1.0]], [[0.0, -0.1], [0.0, -0.1]]) == []
    assert passages_s([[1.5, 3.0], [3.5, 3.0]], [[0.0, 0.0], [0.0, 0.0]]) == []
    assert passages_s([[3.5, 1.5], [4.5, 1.5]], [[0.0, 0.1], [0.0, 0.1]]) == []
