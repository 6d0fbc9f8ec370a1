"""How far agents drove.

``distance_m``  the length of an agent's way
"""

from itertools import pairwise

from tlcomm_core.records import RunRecords

__all__ = ["distance_m"]


def distance_m(agent: str, records: RunRecords) -> float:
    """Return Σ_k ‖p_{k+1} − p_k‖ over an agent's odometry, exact as it drives straights."""
    poses = (seen.pose for seen in records.odometry if seen.agent == agent)
    return sum(earlier.distance_m(later.x_m, later.y_m) for earlier, later in pairwise(poses))
