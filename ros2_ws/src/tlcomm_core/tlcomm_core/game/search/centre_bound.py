"""What a connected placement costs at least, by where its middle is.

``centre_bounds``  a bound from below for each place
``reach``          the places that a team around given middles can be at

A connected placement of N agents has a spanning tree, and every tree has a centre: a node from
which no other is more than ⌊N/2⌋ hops away. Far nodes are few: who is k hops away has a path of k
− 1 nodes behind it, and on another side of the centre there is one as long, else the centre would
lie nearer. So at most N + 1 − 2k nodes are k hops away or more.
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.links import Neighbourhood

__all__ = ["centre_bounds", "reach"]

# Beyond any cost of a round, and small enough for sums to keep their digits.
_FAR_S: Final = 1e6


def centre_bounds(costs: NDArray[np.float64], neighbourhood: Neighbourhood) -> NDArray[np.float64]:
    """Return for each place what any connected placement with its centre there costs at least.

    With m_i(k, z) the least of c_i within k hops of z, an agent at k hops saves at most
    Σ_{l≤k} m_i(l−1, z) − m_i(l, z) over c_i(z); the savings of hop k are counted for the
    N + 1 − 2k agents with the largest ones.

    Args:
        costs: float[N, Z], c_i(z); +inf where the agent can't be.
        neighbourhood: of the Z places.

    Returns:
        float[Z], fresh; a million and more where there is no such placement.

    Source: that every tree has one or two centres, C. Jordan, "Sur les assemblages de lignes"
        (1869); the count of far nodes is argued above.
    Cost: O(N²·Z + N·Z·D).
    """
    team = len(costs)
    least = np.minimum(costs, _FAR_S)
    bounds: NDArray[np.float64] = np.zeros(costs.shape[1])
    for hops in range(1, team // 2 + 1):
        nearer, least = least, np.minimum(least, neighbourhood.least(least))
        unused = 2 * hops - 1
        savings = np.partition(nearer - least, unused - 1, axis=0)[:unused]
        bounds += savings.sum(axis=0)
    bounds += least.sum(axis=0)
    return bounds


def reach(centres: NDArray[np.bool_], team: int, neighbourhood: Neighbourhood) -> NDArray[np.bool_]:
    """Return the places at most ⌊N/2⌋ hops from some centres, bool[Z]."""
    outside = np.where(centres, 0.0, 1.0)
    for _ in range(team // 2):
        outside = np.minimum(outside, neighbourhood.least(outside))
    inside: NDArray[np.bool_] = outside < 1.0
    return inside
