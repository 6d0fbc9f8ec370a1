"""Sight past obstacles."""

import numpy as np
import pytest

from tlcomm_core.workspace import sight
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.sight import sightlines

HALL = Grid((10.0, 10.0), 0.5, [(3.0, 3.0, 4.0, 5.0), (6.0, 0.0, 6.5, 2.0)])


def sees(
    start_m: tuple[float, float], end_m: tuple[float, float], clearance_m: float = 0.0
) -> bool:
    """Ask for one pair, either way round."""
    forth, back = (
        bool(sightlines(HALL, np.array(one), np.array(other), clearance_m))
        for one, other in ((start_m, end_m), (end_m, start_m))
    )
    assert forth == back
    return forth


def test_an_obstacle_between_two_points_hides_them() -> None:
    """Straight through, through a corner's inside, and from side to side."""
    assert not sees((2.0, 4.0), (5.0, 4.0))
    assert not sees((2.5, 4.5), (3.6, 5.5))
    assert not sees((3.5, 2.0), (3.5, 6.0))


def test_what_is_not_between_does_not_matter() -> None:
    """Beside it, before it and behind it there is sight."""
    assert sees((2.0, 5.5), (5.0, 5.5))
    assert sees((1.0, 4.0), (2.9, 4.0))
    assert sees((4.1, 4.0), (5.0, 4.0))
    assert sees((2.0, 5.0), (3.4, 6.4))


@pytest.mark.parametrize("x_m", [3.0, 3.0 - 1e-10, 4.0])
def test_touching_is_seeing(x_m: float) -> None:
    """Along a wall, at a corner, and off a wall that one stands at."""
    assert sees((x_m, 2.0), (x_m, 6.0))
    assert sees((2.0, 4.0), (3.0, 5.0))
    assert sees((2.0, 4.0), (3.0, 4.0))


def test_a_clearance_keeps_the_line_away() -> None:
    """Beside a wall by less than the clearance there is no sight, by more there is."""
    assert sees((2.0, 5.1), (5.0, 5.1), 0.09)
    assert not sees((2.0, 5.1), (5.0, 5.1), 0.11)


def test_points_broadcast() -> None:
    """One point is compared with many, and many with many."""
    places_m = np.array([[2.0, 4.0], [5.0, 4.0], [3.5, 6.0]])
    assert sightlines(HALL, places_m[0], places_m).tolist() == [True, False, True]
    all_pairs = sightlines(HALL, places_m[:, np.newaxis], places_m)
    assert all_pairs.tolist() == [[True, False, True], [False, True, True], [True, True, True]]
    assert sightlines(HALL, places_m[:0], places_m[:0]).tolist() == []


def test_an_empty_hall_hides_nothing() -> None:
    """Without obstacles all see each other."""
    places_m = np.array([[2.0, 4.0], [5.0, 4.0]])
    assert sightlines(Grid((10.0, 10.0), 0.5), places_m, places_m[::-1]).all()


def test_chunks_do_not_show(monkeypatch: pytest.MonkeyPatch) -> None:
    """However many are looked at together, the answer is the same."""
    rng = np.random.default_rng(1)
    places_m = rng.uniform(0.0, 10.0, (2, 500, 2))
    whole = sightlines(HALL, *places_m)
    assert 100 < whole.sum() < 490
    monkeypatch.setattr(sight, "_CHUNK", 7)
    assert (sightlines(HALL, *places_m) == whole).all()
