"""Who hears whom: range, and sight past obstacles."""

import numpy as np
import pytest

from tlcomm_core.workspace.grid import Grid
from tlcomm_core.world.radio import pair_indices
from tlcomm_core.world.reach import Reach

WALLED = Reach(2.0, Grid((6.0, 6.0), 0.5, [(2.0, 2.0, 3.0, 4.0)]))


def changes_s(
    places: list[list[float]], velocities: list[list[float]], linked: bool = True
) -> list[float]:
    """Return the corners' times after which two agents' sight is another than now, ascending."""
    times_s, pairs = WALLED.sight_changes_s(
        np.array(places), np.array(velocities), np.array([linked]), 10.0
    )
    assert not pairs.any()
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


def test_sight_goes_when_a_corner_is_in_line() -> None:
    """Along both sides of the wall: hidden from the first corner in line to the last."""
    abreast = [[1.5, 0.0], [3.4, 0.38]], [[0.0, 1.0], [0.0, 1.0]]
    assert changes_s(*abreast) == pytest.approx([1.7, 1.9, 3.7], abs=1e-6)
    assert changes_s(*abreast, linked=False) == pytest.approx([3.9], abs=1e-6)


def test_one_drives_while_the_other_waits() -> None:
    """From (3.4, 4.5) the corner at (2, 4) is in line with the track x = 1.5 at y = 3.82."""
    coming = [[1.5, 3.0], [3.4, 4.5]], [[0.0, 0.1], [0.0, 0.0]]
    assert changes_s(*coming, linked=False) == pytest.approx([(4.5 - 3.0 - 9.5 / 14.0) / 0.1])
    assert changes_s(*coming) == []


def test_what_is_out_of_reach_is_left_out() -> None:
    """Far from any corner, at rest, or with the corner behind one of them, nothing changes."""
    assert changes_s([[0.5, 0.2], [0.5, 1.0]], [[0.0, -0.1], [0.0, -0.1]]) == []
    assert changes_s([[1.5, 3.0], [3.5, 3.0]], [[0.0, 0.0], [0.0, 0.0]], linked=False) == []
    assert changes_s([[3.5, 1.5], [4.5, 1.5]], [[0.0, 0.1], [0.0, 0.1]]) == []
