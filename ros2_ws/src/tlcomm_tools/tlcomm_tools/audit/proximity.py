"""Whether two agents were in range and sight of each other at given times, from their tracks alone.

``Proximity``  of two agents
"""

from dataclasses import dataclass
from itertools import pairwise
from typing import Final, Self

import numpy as np
from numpy.typing import NDArray

from tlcomm_tools.audit.clearance import obstacles_of
from tlcomm_tools.audit.evidence import Evidence
from tlcomm_tools.audit.links import Interval, link_intervals
from tlcomm_tools.audit.sight import Box, hidden
from tlcomm_tools.audit.tracks import Track

__all__ = ["Proximity"]

# Rounding of positions and times, far below anything physical.
_RANGE_SLACK_M: Final = 1e-9
_TIME_SLACK_S: Final = 1e-6
# Times are whole nanoseconds.
_INSTANT_S: Final = 0.5e-9


@dataclass(frozen=True, slots=True, eq=False)
class Proximity:
    """Two agents' distance over time, and what stood between them.

    Attributes:
        one: an agent.
        other: another.
        range_m: R.
        walls: from when on which obstacles hide agents from each other, ascending from 0 s.
    """

    one: Track
    other: Track
    range_m: float
    walls: tuple[tuple[float, tuple[Box, ...]], ...]

    @classmethod
    def of(cls, evidence: Evidence, one: str, other: str) -> Self:
        """Return that of two agents with tracks."""
        scenario = evidence.scenario
        walls = obstacles_of(scenario.workspace) if scenario.radio.line_of_sight else ((0.0, ()),)
        track_of = evidence.track_of
        return cls(track_of[one], track_of[other], scenario.communication.range_m, walls)

    def distances_m(self, times_s: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return how far they were from each other at these times."""
        apart_m = self.one.at(times_s) - self.other.at(times_s)
        return np.hypot(apart_m[:, 0], apart_m[:, 1])

    def linked_at(self, times_s: NDArray[np.float64]) -> NDArray[np.bool_]:
        """Tell at which times they were in range, and in sight if need be."""
        linked: NDArray[np.bool_] = self.distances_m(times_s) <= self.range_m + _RANGE_SLACK_M
        one_m, other_m = self.one.at(times_s), self.other.at(times_s)
        since_s = np.array([from_s for from_s, _ in self.walls])
        standing = np.searchsorted(since_s, times_s + _INSTANT_S, side="right") - 1
        for index, (_, boxes) in enumerate(self.walls):
            then = linked & (standing == index)
            linked[then] = ~hidden(one_m[then], other_m[then], boxes)
        return linked

    def linked_within(
        self, from_s: NDArray[np.float64], to_s: NDArray[np.float64]
    ) -> NDArray[np.bool_]:
        """Tell in which of these stretches of time they were linked at some time."""
        linked = np.zeros(len(from_s), dtype=np.bool_)
        if len(from_s):
            for begin_s, end_s in self._intervals():
                linked |= (from_s <= end_s + _TIME_SLACK_S) & (to_s >= begin_s - _TIME_SLACK_S)
        return linked

    def _intervals(self) -> list[Interval]:
        """Return when they were linked, cut where the obstacles change."""
        found: list[Interval] = []
        for (from_s, boxes), (to_s, _) in pairwise((*self.walls, (np.inf, ()))):
            for begin_s, end_s in link_intervals(self.one, self.other, self.range_m, boxes):
                if begin_s < to_s and end_s > from_s:
                    found.append((max(begin_s, from_s), min(end_s, to_s)))
        return found
