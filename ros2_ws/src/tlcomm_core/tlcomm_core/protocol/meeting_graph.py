"""Who exchanges with whom at a meeting, as all know it from the offers' places.

``meeting_graph``  its links, and how many exchanges reach everyone
"""

from collections.abc import Sequence
from itertools import product

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.game.links import LINK_TOLERANCE_M
from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.protocol.team import Team
from tlcomm_core.world.radio import diameter, distances_m, edges, pair_indices

__all__ = ["meeting_graph"]


def meeting_graph(
    offers: Sequence[MemberOffer], team: Team, sightings: Sequence[NDArray[np.bool_]] = ()
) -> tuple[tuple[tuple[int, int], ...], int]:
    """Return the links that exchanges wait for, and how many exchanges reach everyone.

    These are the links that hold although both ends are off by their tolerance: a pair reported
    exactly R apart, or along a wall, may hear each other or not. Only a team that isn't connected
    by such links, as at its start it may not be, relies on longer ones, up to the first length that
    connects it; or else on less sure sightings, and at last on none.

    Args:
        offers: of all members, sorted by agent.
        team: the team.
        sightings: masks [N, N] of which members see each other, from the surest to the least sure.

    Returns:
        Pairs of indices (i, j), i < j, into the offers, ascending; and the graph's diameter, at
        least 1.
    """
    places_m = np.array([(offer.x_m, offer.y_m) for offer in offers])
    sure_m = team.planned_range_m + LINK_TOLERANCE_M
    distance_m = distances_m(places_m)
    longer_m = np.unique(distance_m[distance_m > sure_m]).tolist()
    pairs = pair_indices(len(offers))
    masks = (*(sighting[pairs] for sighting in sightings), np.ones(len(distance_m), dtype=np.bool_))
    for is_seen, range_m in product(masks, (sure_m, *longer_m)):
        links = edges(len(offers), is_seen & (distance_m <= range_m))
        hops = diameter(len(offers), links)
        if hops is not None:
            return links, max(1, hops)
    raise LocalMisuseError(f"{places_m!r} are places at no finite distance")
