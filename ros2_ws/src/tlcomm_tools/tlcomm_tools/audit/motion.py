"""Whether an agent moved as it can: no faster than its drive, and without jumps.

``audit_motion``  what is wrong with its odometry
"""

import math
from collections.abc import Iterator, Sequence
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.scenario.model import Scenario
from tlcomm_core.world.observation import Odometry

__all__ = ["audit_motion"]

# Rounding of speeds, relative to the limit.
_SPEED_SLACK: Final = 1e-6
# The noise on a command is normal: beyond this many deviations it isn't the noise's doing.
_NOISE_DEVIATIONS: Final = 6.0
_YAW_SLACK_RAD: Final = 0.02


def audit_motion(scenario: Scenario, agent: str, samples: Sequence[Odometry]) -> Iterator[str]:
    """Say where an agent's odometry has it faster than it can be, or somewhere else at once.

    Args:
        scenario: limits, noise and tolerances.
        agent: whose.
        samples: its own, finite, in order of time.
    """
    if not samples:
        return
    drive, noise = scenario.drive_of(agent), scenario.noise
    rows = np.array(
        [
            (own.pose.x_m, own.pose.y_m, own.pose.yaw_rad, own.linear_mps, own.angular_radps)
            for own in samples
        ]
    )
    times_s = np.array([own.stamp_ns for own in samples]) * 1e-9
    most_mps = drive.linear_mps * (1.0 + _NOISE_DEVIATIONS * noise.linear)
    most_radps = drive.angular_radps * (1.0 + _NOISE_DEVIATIONS * noise.angular)
    yield from _excess(agent, times_s, np.abs(rows[:, 3]), most_mps, ("drives at", "m/s"))
    yield from _excess(agent, times_s, np.abs(rows[:, 4]), most_radps, ("turns at", "rad/s"))
    yield from _jumps(agent, times_s, rows, drive.position_tolerance_m)


def _excess(
    agent: str,
    times_s: NDArray[np.float64],
    speeds: NDArray[np.float64],
    most: float,
    words: tuple[str, str],
) -> Iterator[str]:
    """Say when a speed was first beyond its limit, and by how much at most."""
    over = np.flatnonzero(speeds > most * (1.0 + _SPEED_SLACK))
    if len(over):
        first = over[0]
        verb, unit = words
        yield (
            f"{agent}: {times_s[first]:.3f} s: {verb} {speeds[first]:.3f} {unit}, faster than "
            f"{most:g} {unit}{_in_all(len(over), speeds[over].max(), unit)}"
        )


def _jumps(
    agent: str, times_s: NDArray[np.float64], rows: NDArray[np.float64], slack_m: float
) -> Iterator[str]:
    """Say where a pose doesn't follow from the one before with the velocity stated there."""
    off_m, off_rad = _surprises(times_s, rows)
    for off, slack, verb, unit in (
        (off_m, slack_m, "jumps by", "m"),
        (off_rad, _YAW_SLACK_RAD, "jumps in yaw by", "rad"),
    ):
        over = np.flatnonzero(off > slack)
        if len(over):
            first = over[0]
            yield (
                f"{agent}: {times_s[first + 1]:.3f} s: {verb} {off[first]:.3f} {unit} from where "
                f"its velocity leads{_in_all(len(over), off[over].max(), unit)}"
            )


def _surprises(
    times_s: NDArray[np.float64], rows: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return how far each sample but the first is from what the one before foretells.

    Source: exact motion at constant v and ω: a chord of length v·t·sin(ωt/2)/(ωt/2) along the mean
        heading.
    """
    x_m, y_m, yaw_rad, linear_mps, angular_radps = rows[:-1].T
    duration_s = np.diff(times_s)
    half_rad = 0.5 * angular_radps * duration_s
    chord_m = linear_mps * duration_s * np.sinc(half_rad / math.pi)
    off_m = np.hypot(
        rows[1:, 0] - x_m - chord_m * np.cos(yaw_rad + half_rad),
        rows[1:, 1] - y_m - chord_m * np.sin(yaw_rad + half_rad),
    )
    turned_rad = rows[1:, 2] - yaw_rad - 2.0 * half_rad
    off_rad = np.abs((turned_rad + math.pi) % math.tau - math.pi)
    return off_m, off_rad


def _in_all(count: int, most: float, unit: str) -> str:
    return "" if count == 1 else f"; {count} times, at most {most:.3f} {unit}"
