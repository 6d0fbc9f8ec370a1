"""Where each agent was, from its odometry alone.

``Track``         one agent's positions over time
``build_tracks``  all agents' tracks, and what is wrong with the odometry
"""

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.world.observation import Odometry

__all__ = ["Track", "build_tracks"]

# The contract has odometry every second at the latest.
_MAX_GAP_S = 2.0


@dataclass(frozen=True, slots=True, eq=False)
class Track:
    """One agent's positions: linear between the samples, as driving straight makes them.

    Attributes:
        agent: whose.
        times_s: [S] ascending.
        positions_m: [S, 2] at those times.
    """

    agent: str
    times_s: NDArray[np.float64]
    positions_m: NDArray[np.float64]

    def at(self, times_s: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the positions [T, 2] at these times."""
        return np.stack(
            [np.interp(times_s, self.times_s, self.positions_m[:, axis]) for axis in (0, 1)],
            axis=1,
        )


def build_tracks(
    odometry: Iterable[Odometry], agents: Sequence[str], end_s: float
) -> tuple[list[Track], list[str]]:
    """Return every agent's track up to the end, and a line per fault of the odometry.

    The last sample is carried on with its own velocity. An agent without odometry has no track.

    Args:
        odometry: of all agents, in order of time.
        agents: whose odometry is expected.
        end_s: end of the run.
    """
    samples: dict[str, list[Odometry]] = {agent: [] for agent in agents}
    for sample in odometry:
        if sample.agent in samples:
            samples[sample.agent].append(sample)
    faults = [f"{agent}: no odometry" for agent in agents if not samples[agent]]
    tracks = [_build_track(agent, own, end_s) for agent, own in samples.items() if own]
    faults += [fault for track in tracks for fault in _gaps(track, end_s, samples[track.agent])]
    return tracks, faults


def _build_track(agent: str, samples: Sequence[Odometry], end_s: float) -> Track:
    times_s = np.array([sample.stamp_ns for sample in samples]) * 1e-9
    positions_m = np.array([(sample.pose.x_m, sample.pose.y_m) for sample in samples])
    # Of several samples at the same time the last one holds.
    last = np.append(np.diff(times_s) > 0.0, True)
    times_s, positions_m = times_s[last], positions_m[last]
    left_s = end_s - times_s[-1]
    if left_s > 0.0:
        final = samples[-1]
        heading = (math.cos(final.pose.yaw_rad), math.sin(final.pose.yaw_rad))
        reached_m = positions_m[-1] + left_s * final.linear_mps * np.array(heading)
        times_s = np.append(times_s, end_s)
        positions_m = np.vstack([positions_m, reached_m])
    return Track(agent, times_s, positions_m)


def _gaps(track: Track, end_s: float, samples: Sequence[Odometry]) -> Iterator[str]:
    seen_s = np.array([0.0, *(sample.stamp_ns * 1e-9 for sample in samples), end_s])
    gaps_s = np.diff(seen_s)
    for index in np.flatnonzero(gaps_s > _MAX_GAP_S):
        yield (
            f"{track.agent}: no odometry from {seen_s[index]:.3f} s to {seen_s[index + 1]:.3f} s"
        )
