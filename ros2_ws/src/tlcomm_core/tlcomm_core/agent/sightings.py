"""Who hears whom on a map, if obstacles may be in the way.

``links_on``   the links between all places that meetings are planned with
``sightings``  which members see each other where they are now
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.links import Links
from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.protocol.team import Team
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.sight import sightlines

__all__ = ["links_on", "sightings"]


def links_on(grid: Grid, team: Team) -> Links:
    """Return the links between a map's places that hold although members are a little off them."""
    clearance_m = team.clearance_m
    if clearance_m is None:
        return Links(grid.locations_m, team.planned_range_m)

    def sees(place: int, others: NDArray[np.intp]) -> NDArray[np.bool_]:
        places_m = grid.locations_m
        return sightlines(grid, places_m[place], places_m[others], clearance_m)

    return Links(grid.locations_m, team.planned_range_m, sees)


def sightings(
    grid: Grid, team: Team, offers: Sequence[MemberOffer]
) -> tuple[NDArray[np.bool_], ...]:
    """Tell which members see each other from the places of their offers.

    Returns:
        Masks [N, N], from the surest to the least sure: who sees each other although both are a
        little off; who does from exactly there. None at all if radios needn't see.
    """
    if team.clearance_m is None:
        return ()
    places_m = np.array([(offer.x_m, offer.y_m) for offer in offers])
    return tuple(
        sightlines(grid, places_m[:, None], places_m[None], clearance_m)
        for clearance_m in (team.clearance_m, 0.0)
    )
