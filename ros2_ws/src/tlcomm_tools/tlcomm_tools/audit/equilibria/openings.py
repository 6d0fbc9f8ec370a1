"""Where one agent may go while the others stay, so that the team can meet.

``Openings``  on a map
"""

from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.scenario.model import Scenario
from tlcomm_tools.audit.equilibria.cells import Cells
from tlcomm_tools.audit.sight import Box, hidden

__all__ = ["Openings"]

# What a link is forgiven by rounding, and what a separation is.
_SLACK_M: Final = 1e-9
# Of two, neither keeps the other connected.
_LEAST_RESILIENT_TEAM: Final = 3


class Openings:
    """Where agents may go on a map: linked to the others, apart from them, and not relied upon.

    Places are linked within R less the tolerance at either end; where radios must see, the straight
    between them keeps clear of obstacles by the tolerance, too.
    """

    def __init__(self, scenario: Scenario, cells: Cells, walls: Sequence[Box]) -> None:
        """Take a map.

        Args:
            scenario: range, tolerances and demands.
            cells: of the map.
            walls: its obstacles.
        """
        tolerance_m, demands = scenario.position_tolerance_m, scenario.communication
        self._cells: Final = cells
        self._reach_m: Final = demands.range_m - 2.0 * tolerance_m
        self._apart_m: Final = demands.separation_m
        self._is_resilient: Final = demands.resilience > 0
        hiding = walls if scenario.radio.line_of_sight else ()
        self._walls: Final = tuple(_grown(box, tolerance_m) for box in hiding)
        self._linked = lru_cache(None)(self._linked_to)

    def open_to(self, places: Sequence[int]) -> Iterator[NDArray[np.bool_]]:
        """Yield for each agent of a team which cells are open to it while the others stay.

        Args:
            places: their cells, in order.
        """
        linked = np.stack([self._linked(place) for place in places])
        neighbours = [
            sum(1 << other for other in np.flatnonzero(row).tolist()) for row in linked[:, places]
        ]
        crowded = self._crowded(places)
        everybody = (1 << len(places)) - 1
        for agent in range(len(places)):
            others = everybody & ~(1 << agent)
            is_open = _joining(linked, neighbours, others)
            if self._is_resilient and len(places) >= _LEAST_RESILIENT_TEAM:
                is_open &= _backing(linked, neighbours, others)
            if crowded is not None:
                is_open &= ~np.delete(crowded, agent, axis=0).any(axis=0)
            yield is_open

    def _linked_to(self, place: int) -> NDArray[np.bool_]:
        """Tell, [Z], which cells are linked to one; it is itself."""
        centres_m = self._cells.centres_m
        apart_m = self._distances_m(place)
        linked: NDArray[np.bool_] = apart_m <= self._reach_m + _SLACK_M
        if self._walls:
            here_m = np.broadcast_to(centres_m[place], centres_m[linked].shape)
            linked[linked] = ~hidden(here_m, centres_m[linked], self._walls)
            linked[place] = True
        return linked

    def _crowded(self, places: Sequence[int]) -> NDArray[np.bool_] | None:
        """Tell, [N, Z], which cells are too close to each of some; nothing if none can be."""
        if not self._apart_m:
            return None
        apart_m = np.stack([self._distances_m(place) for place in places])
        crowded: NDArray[np.bool_] = apart_m < self._apart_m - _SLACK_M
        return crowded

    def _distances_m(self, place: int) -> NDArray[np.float64]:
        distances_m: NDArray[np.float64] = np.hypot(
            *(self._cells.centres_m - self._cells.centres_m[place]).T
        )
        return distances_m


def _joining(
    linked: NDArray[np.bool_], neighbours: Sequence[int], others: int
) -> NDArray[np.bool_]:
    """Tell, [Z], where one more agent connects some, given as a bit mask."""
    joining = np.ones(linked.shape[1], dtype=np.bool_)
    for part in _parts(neighbours, others):
        joining &= linked[_members(part)].any(axis=0)
    return joining


def _backing(
    linked: NDArray[np.bool_], neighbours: Sequence[int], others: int
) -> NDArray[np.bool_]:
    """Tell, [Z], where one more agent connects some, whoever of all fails."""
    if len(_parts(neighbours, others)) > 1:
        return np.zeros(linked.shape[1], dtype=np.bool_)
    backing = np.ones(linked.shape[1], dtype=np.bool_)
    for lost in _members(others):
        backing &= _joining(linked, neighbours, others & ~(1 << lost))
    return backing


def _parts(neighbours: Sequence[int], nodes: int) -> list[int]:
    """Return the connected components of a graph over some of its nodes, all as bit masks."""
    parts = []
    while nodes:
        part = frontier = nodes & -nodes
        while frontier:
            node = frontier.bit_length() - 1
            new = neighbours[node] & nodes & ~part
            part |= new
            frontier = (frontier & ~(1 << node)) | new
        parts.append(part)
        nodes &= ~part
    return parts


def _members(mask: int) -> list[int]:
    return [node for node in range(mask.bit_length()) if mask >> node & 1]


def _grown(box: Box, by_m: float) -> Box:
    x_min, y_min, x_max, y_max = box
    return x_min - by_m, y_min - by_m, x_max + by_m, y_max + by_m
