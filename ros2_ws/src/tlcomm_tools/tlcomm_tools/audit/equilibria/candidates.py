"""When an agent could be where, and what that costs it, on a map that rounds are planned on.

``Candidates``  all strategies of one agent
``Ground``      a map, with what follows from it
``grounds_of``  the maps of a scenario
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.units import nanoseconds
from tlcomm_tools.audit.clearance import obstacles_of
from tlcomm_tools.audit.equilibria.cells import Cells
from tlcomm_tools.audit.equilibria.openings import Openings
from tlcomm_tools.audit.equilibria.travel import Gait, Travel, Waypoint

__all__ = ["Candidates", "Ground", "grounds_of"]


@dataclass(frozen=True, slots=True, eq=False)
class Candidates:
    """All strategies (z, h) of one agent.

    Attributes:
        steps: [H] the indices h.
        arrival_s: [H, Z] t_i; infinite where no way leads.
        extra_s: [H, Z] δ_i; the same.
    """

    steps: tuple[int, ...]
    arrival_s: NDArray[np.float64]
    extra_s: NDArray[np.float64]


class Ground:
    """A map, with what follows from it.

    Attributes:
        cells: of the map.
        openings: where agents may go.
    """

    def __init__(self, scenario: Scenario, cells: Cells, openings: Openings, late_s: float) -> None:
        """Take a map.

        Args:
            scenario: with the regions that agents may keep out of.
            cells: of the map.
            openings: on it.
            late_s: what agents reckon for their controllers, as in ``Gait``.
        """
        self.cells: Final = cells
        self.openings: Final = openings
        self._regions: Final = scenario.workspace.regions
        self._late_s: Final = late_s
        self._travel: dict[tuple[Gait, tuple[str, ...]], Travel] = {}

    def candidates(self, offer: MemberOffer, departure_s: float) -> Candidates:
        """Return an agent's candidates: after each of its steps but the last.

        Args:
            offer: what it laid open, sound.
            departure_s: from when its steps are timed.
        """
        travel = self._travel_of(offer)
        shape = (len(offer.stops) - 1, len(self.cells))
        arrival_s, extra_s = np.full(shape, np.inf), np.full(shape, np.inf)
        for row, (stop, following) in enumerate(pairwise(offer.stops)):
            begin = Waypoint(stop.x_m, stop.y_m, stop.yaw_rad)
            detour = travel.detour(begin, (following.x_m, following.y_m))
            if detour is not None:
                arrival_s[row] = departure_s + stop.finish_offset_s + detour.there_s
                extra_s[row] = detour.extra_s
        return Candidates(tuple(own.task_index for own in offer.stops[:-1]), arrival_s, extra_s)

    def _travel_of(self, offer: MemberOffer) -> Travel:
        gait = Gait(offer.linear_mps, offer.angular_radps, self._late_s)
        key = (gait, offer.avoided)
        if key not in self._travel:
            avoided = np.zeros(len(self.cells), dtype=np.bool_)
            for name in offer.avoided:
                avoided |= self.cells.touching(self._regions[name])
            self._travel[key] = Travel(self.cells, avoided, gait)
        return self._travel[key]


def grounds_of(scenario: Scenario, late_s: float) -> Mapping[int, Ground]:
    """Return the maps of a scenario, by the time from which each holds (ns).

    Of a map that comes later agents know the closed cells, not the obstacles in them; what has the
    same cells as the first is the first.
    """
    grounds: dict[int, Ground] = {}
    first: Cells | None = None
    for at_s, boxes in obstacles_of(scenario.workspace):
        cells = Cells(scenario.workspace, boxes)
        if first is None:
            first, walls = cells, boxes
        elif np.array_equal(cells.free, first.free):
            grounds[nanoseconds(at_s)] = grounds[0]
            continue
        else:
            walls = cells.closed_boxes()
        openings = Openings(scenario, cells, walls)
        grounds[nanoseconds(at_s)] = Ground(scenario, cells, openings, late_s)
    return grounds
