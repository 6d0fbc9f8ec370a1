"""How long agents take that turn on the spot and drive straight ahead.

``Gait``     how an agent drives
``Waypoint`` where it is, and how it is turned
``Detour``   what it takes to go somewhere by way of each cell
``Travel``   an agent's times on a map
"""

import math
from dataclasses import dataclass
from functools import lru_cache
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from tlcomm_tools.audit.equilibria.cells import HEADINGS, Cells, Moves

__all__ = ["Detour", "Gait", "Travel", "Waypoint"]

_EIGHTH_RAD: Final = math.tau / HEADINGS
# As near as this to a cell's middle, or to one of the eight headings, is there.
_SAME_M: Final = 1e-6
_SAME_RAD: Final = 1e-6
# Times as near as this are equal; of equally fast ways the one that ends with the first heading is
# taken.
_TIE_S: Final = 1e-9
_KEPT_BYTES: Final = 128 * 2**20


@dataclass(frozen=True, slots=True)
class Gait:
    """How an agent drives.

    Attributes:
        linear_mps: its speed ahead.
        angular_radps: its speed on the spot.
        late_s: what is reckoned for a controller that is late: once for each leg that moves,
            for each eighth of a turn, and for each turn that begins between the eight headings.
    """

    linear_mps: float
    angular_radps: float
    late_s: float = 0.0


@dataclass(frozen=True, slots=True)
class Waypoint:
    """Where an agent is, and how it is turned."""

    x_m: float
    y_m: float
    yaw_rad: float


@dataclass(frozen=True, slots=True, eq=False)
class Detour:
    """What it takes to go somewhere by way of each cell; infinite where no way leads.

    Attributes:
        there_s: [Z] until the agent is there.
        extra_s: [Z] what the whole way takes longer than the direct one.
    """

    there_s: NDArray[np.float64]
    extra_s: NDArray[np.float64]


@dataclass(frozen=True, slots=True, eq=False)
class _Start:
    """How a way begins: over the cell's middle, then with a turn to a heading.

    ``turns_s`` is infinite for headings with which it doesn't begin.
    """

    cell: int
    to_middle_s: float
    turns_s: NDArray[np.float64]


class Travel:
    """An agent's times on a map: the shortest, with the heading that the way before ended with.

    A state is a cell and one of eight headings. A turn leads to the next heading on either side, a
    move ahead to the next cell.

    Source: T_i of Section IV-A of the paper, and δ of Eq. (5).
    """

    def __init__(self, cells: Cells, avoided: NDArray[np.bool_], gait: Gait) -> None:
        """Lay the graph of states.

        Args:
            cells: of the map.
            avoided: [Z] which of them the agent keeps out of.
            gait: how it drives.
        """
        self._cells: Final = cells
        self._gait: Final = gait
        self._ahead: Final = _graph(len(cells), cells.moves(avoided), gait)
        self._back: Final = self._ahead.T.tocsr()
        kept = max(16, _KEPT_BYTES // (8 * (HEADINGS + 4) * max(len(cells), 1)))
        self._onward = lru_cache(kept)(self._search_to)
        self._reach = lru_cache(kept)(self._search_from)
        self.detour = lru_cache(kept)(self._make_detour)

    def _make_detour(self, begin: Waypoint, end_m: tuple[float, float]) -> Detour | None:
        """Return what it takes to go from one place to another by way of each cell.

        Nothing if one of both isn't in a free cell, or no way leads from one to the other.
        """
        start, target = self._start(begin), self._cells.at(*end_m)
        if start is None or target is None:
            return None
        there_s, headings = self._reach(begin)
        to_target_s = self._onward(target)
        direct_s = start.to_middle_s + float((to_target_s[start.cell] + start.turns_s).min())
        if start.cell == target:
            direct_s = float(there_s[target])
        if not math.isfinite(direct_s):
            return None
        onward_s = to_target_s[np.arange(len(headings)), headings]
        # Who needn't move keeps its yaw, whichever it is.
        onward_s[there_s == 0.0] = direct_s
        return Detour(there_s, np.maximum(there_s + onward_s - direct_s, 0.0))

    def _search_to(self, target: int) -> NDArray[np.float64]:
        """Return the times, [Z, 8], from every state to a cell, however turned there."""
        ends = np.arange(HEADINGS) + target * HEADINGS
        found = dijkstra(self._back, indices=ends, min_only=True).reshape(-1, HEADINGS)
        times_s: NDArray[np.float64] = found + self._gait.late_s
        times_s[target] = 0.0
        return times_s

    def _search_from(self, begin: Waypoint) -> tuple[NDArray[np.float64], NDArray[np.intp]]:
        """Return the times, [Z], to every cell, and the headings with which one gets there."""
        start = self._start(begin)
        assert start is not None, "only asked for after a look at the cell"
        headings = np.flatnonzero(np.isfinite(start.turns_s))
        found = dijkstra(self._ahead, indices=start.cell * HEADINGS + headings)
        times_s = (found + start.turns_s[headings, None]).min(axis=0).reshape(-1, HEADINGS)
        first = np.argmax(times_s <= times_s.min(axis=1, keepdims=True) + _TIE_S, axis=1)
        there_s = times_s[np.arange(len(first)), first] + (start.to_middle_s + self._gait.late_s)
        is_off = start.to_middle_s > 0.0
        there_s[start.cell] = start.to_middle_s + self._gait.late_s if is_off else 0.0
        return there_s, first

    def _start(self, begin: Waypoint) -> _Start | None:
        cell = self._cells.at(begin.x_m, begin.y_m)
        if cell is None:
            return None
        east_m, north_m = (self._cells.centres_m[cell] - (begin.x_m, begin.y_m)).tolist()
        off_m = math.hypot(east_m, north_m)
        if off_m <= _SAME_M:
            return _Start(cell, 0.0, self._first_turns_s(begin.yaw_rad))
        bearing_rad = math.atan2(north_m, east_m)
        turn_s = self._turn_s(bearing_rad - begin.yaw_rad)
        return _Start(
            cell, turn_s + off_m / self._gait.linear_mps, self._first_turns_s(bearing_rad)
        )

    def _first_turns_s(self, yaw_rad: float) -> NDArray[np.float64]:
        """Return what it takes to turn to each heading; no further turn from one of the eight."""
        offs_rad = [_wrapped(heading * _EIGHTH_RAD - yaw_rad) for heading in range(HEADINGS)]
        if min(map(abs, offs_rad)) <= _SAME_RAD:
            return np.array([0.0 if abs(off) <= _SAME_RAD else math.inf for off in offs_rad])
        return np.array([self._turn_s(off_rad) for off_rad in offs_rad])

    def _turn_s(self, off_rad: float) -> float:
        return abs(_wrapped(off_rad)) / self._gait.angular_radps + self._gait.late_s


def _graph(count: int, moves: Moves, gait: Gait) -> csr_array:
    """Return the time of each turn and move between states."""
    states = np.arange(count * HEADINGS).reshape(-1, HEADINGS)
    turn_s = np.full(states.size, _EIGHTH_RAD / gait.angular_radps + gait.late_s)
    begins = [states.ravel(), states.ravel(), states[moves.start, moves.heading]]
    ends = [np.roll(states, 1, axis=1).ravel(), np.roll(states, -1, axis=1).ravel()]
    ends.append(states[moves.end, moves.heading])
    times_s = [turn_s, turn_s, moves.length_m / gait.linear_mps]
    entries = (np.concatenate(times_s), (np.concatenate(begins), np.concatenate(ends)))
    return csr_array(entries, shape=(states.size, states.size))


def _wrapped(angle_rad: float) -> float:
    return (angle_rad + math.pi) % math.tau - math.pi
