"""An agent's way, thinned as it grows."""

import numpy as np

from tlcomm_core.geometry import Pose
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.observation import Odometry
from tlcomm_tools.live.growing import Growing
from tlcomm_tools.live.way import Way

SAMPLES = 2000
TOLERANCE_M = 0.025


def samples() -> list[Odometry]:
    """Return poses of a way with bends, straights and rests, and noise below the tolerance."""
    rng = np.random.default_rng(0)
    turns = np.repeat(rng.integers(-1, 2, (SAMPLES // 10, 2)), 10, axis=0)
    places = np.cumsum(0.1 * turns, axis=0) + rng.uniform(-0.002, 0.002, (SAMPLES, 2))
    return [
        Odometry(nanoseconds(0.5 * number), "east", Pose(x, y, 0.0), 0.0, 0.0)
        for number, (x, y) in enumerate(places.tolist())
    ]


def test_the_way_is_right_wherever_it_was_seen() -> None:
    """However often it is drawn meanwhile, with few of its samples."""
    corners = Growing("path")
    way, seen = Way(corners), samples()
    for number, sample in enumerate(seen):
        way.take(sample)
        if number % 7 == 0:
            way.draw()
    way.draw()
    times_s, x_m, y_m = np.array(corners.items).T
    assert np.all(np.diff(times_s) > 0.0)
    at_s = [0.5 * number for number in range(SAMPLES)]
    places = np.array([(own.pose.x_m, own.pose.y_m) for own in seen])
    off_m = np.hypot(
        np.interp(at_s, times_s, x_m) - places[:, 0], np.interp(at_s, times_s, y_m) - places[:, 1]
    )
    assert off_m.max() < TOLERANCE_M
    assert len(corners.items) < SAMPLES / 4
    steps_m = np.hypot(*np.diff(places, axis=0).T)
    assert abs(way.length_m - steps_m.sum()) < 1e-6


def test_what_is_older_than_the_last_is_left_out() -> None:
    """Time on a page goes forward."""
    corners = Growing("path")
    way = Way(corners)
    for sample in (samples()[5], samples()[2]):
        way.take(sample)
    way.draw()
    assert [row[0] for row in corners.items] == [2.5]
