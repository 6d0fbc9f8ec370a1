"""What the world lets others see.

``Odometry``      one agent's pose and velocity
``Connectivity``  who hears whom
``Occupancy``     the map from a time on
``Reading``       what an agent measures
``Observation``   any of them
"""

from dataclasses import dataclass

from tlcomm_core.geometry import Pose
from tlcomm_core.workspace.grid import Grid

__all__ = ["Connectivity", "Observation", "Occupancy", "Odometry", "Reading"]


@dataclass(frozen=True, slots=True)
class Odometry:
    """An agent's pose, as an odometry message carries it, and the velocity that it has from now."""

    stamp_ns: int
    agent: str
    pose: Pose
    linear_mps: float
    angular_radps: float


@dataclass(frozen=True, slots=True)
class Connectivity:
    """The communication graph G(t) from ``stamp_ns`` on.

    Attributes:
        edges: index pairs (i, j), i < j, into the scenario's agents, ascending.
        connected: whether the whole team is connected.
        distances_m: of each edge's agents from each other; none where they aren't known.
    """

    stamp_ns: int
    edges: tuple[tuple[int, int], ...]
    connected: bool
    distances_m: tuple[float, ...] = ()


@dataclass(frozen=True, slots=True)
class Occupancy:
    """Which cells are free from ``stamp_ns`` on."""

    stamp_ns: int
    grid: Grid


@dataclass(frozen=True, slots=True)
class Reading:
    """What an agent measures of the field by the action that it has just ended.

    Attributes:
        region: the station.
        value: what it reads there.
    """

    stamp_ns: int
    agent: str
    region: str
    value: float


Observation = Odometry | Connectivity | Occupancy | Reading
