"""Whether places hold a team together.

``within_range``       which places are linked
``components``         connected parts of a set of places
``is_connected``       whether there is only one
``connecting_places``  where one agent may go so that the team is connected
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

__all__ = ["LINK_TOLERANCE_M", "components", "connecting_places", "is_connected", "within_range"]

LINK_TOLERANCE_M: Final = 1e-9
"""Rounding that a link is forgiven: two places exactly R apart are linked."""


def within_range(
    from_m: NDArray[np.float64], to_m: NDArray[np.float64], range_m: float
) -> NDArray[np.bool_]:
    """Tell which places lie within range of which.

    Args:
        from_m: [A, 2] places.
        to_m: [B, 2] places.
        range_m: R.

    Returns:
        [A, B], fresh.
    """
    east_m = from_m[:, None, 0] - to_m[None, :, 0]
    north_m = from_m[:, None, 1] - to_m[None, :, 1]
    # No hypot: products, sums and square roots are the same on every machine, libm isn't.
    distance_m: NDArray[np.float64] = np.sqrt(east_m * east_m + north_m * north_m)
    return distance_m <= range_m + LINK_TOLERANCE_M


def components(places_m: NDArray[np.float64], range_m: float) -> tuple[NDArray[np.bool_], ...]:
    """Return the connected components of the graph G over the places.

    Args:
        places_m: [M, 2] places, possibly none.
        range_m: R.

    Returns:
        One mask [M] for each component, by its first place.

    Source: E(Z_c) in Section IV-B1 of the paper.
    """
    linked = within_range(places_m, places_m, range_m)
    parts: list[NDArray[np.bool_]] = []
    left = np.ones(len(places_m), dtype=np.bool_)
    while left.any():
        part = linked[np.argmax(left)]
        while (grown := linked[part].any(axis=0)).sum() > part.sum():
            part = grown
        parts.append(part)
        left &= ~part
    return tuple(parts)


def is_connected(places_m: NDArray[np.float64], range_m: float) -> bool:
    """Tell whether the places [M, 2] form one connected graph within range."""
    return len(components(places_m, range_m)) <= 1


def connecting_places(
    others_m: NDArray[np.float64], locations_m: NDArray[np.float64], range_m: float
) -> NDArray[np.bool_]:
    """Tell at which locations one more agent makes the team connected.

    Args:
        others_m: [M, 2] places of all the others, possibly none.
        locations_m: [Z, 2] locations to choose from.
        range_m: R.

    Returns:
        [Z], fresh: whether the location touches every component of the others' graph.

    Source: Υ_i in Section IV-B3 of the paper, without its ball.
    Cost: O(Z·M).
    """
    near = within_range(locations_m, others_m, range_m)
    mask = np.ones(len(locations_m), dtype=np.bool_)
    for part in components(others_m, range_m):
        mask &= near[:, part].any(axis=1)
    return mask
