"""What an agent's brain is told: immutable facts, named in the past tense.

``OdometryReceived``  where it is and how it moves
``MessageHeard``      a neighbour's message that the radio let through
``TaskChanged``       another task was given to it, and a plan made
``MapChanged``        other ways are open to it
``TimePassed``        nothing but that it is later now
``Event``             any of them
"""

from dataclasses import dataclass

from tlcomm_core.geometry import Pose
from tlcomm_core.planning.plan import LocalPlan
from tlcomm_core.protocol.messages import Message
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.travel import TravelTimes

__all__ = ["Event", "MapChanged", "MessageHeard", "OdometryReceived", "TaskChanged", "TimePassed"]


@dataclass(frozen=True, slots=True)
class OdometryReceived:
    """Pose and twist at ``stamp_s``; the twist holds until the next odometry."""

    stamp_s: float
    pose: Pose
    linear_mps: float
    angular_radps: float


@dataclass(frozen=True, slots=True)
class MessageHeard:
    """A message from a neighbour."""

    message: Message


@dataclass(frozen=True, slots=True)
class TaskChanged:
    """Another task was given to the agent.

    Attributes:
        task: its formula's text.
        plan: its plan, from where the next meeting is.
        grid: the map that the plan was made on.
    """

    task: str
    plan: LocalPlan
    grid: Grid


@dataclass(frozen=True, slots=True)
class MapChanged:
    """The map is another.

    Attributes:
        map_ns: the time from which it holds.
        travel: the agent's travel times on it.
    """

    map_ns: int
    travel: TravelTimes


@dataclass(frozen=True, slots=True)
class TimePassed:
    """The time that the brain had asked for has come, or any other."""


Event = OdometryReceived | MessageHeard | TaskChanged | MapChanged | TimePassed
