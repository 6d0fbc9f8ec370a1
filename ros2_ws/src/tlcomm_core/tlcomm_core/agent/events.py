"""What an agent's brain is told: immutable facts, named in the past tense.

``OdometryReceived``  where it is and how it moves
``MessageHeard``      a neighbour's message that the radio let through
``TaskChanged``       another task was given to it, and a plan made
``TimePassed``        nothing but that it is later now
``Event``             any of them
"""

from dataclasses import dataclass

from tlcomm_core.geometry import Pose
from tlcomm_core.planning.plan import LocalPlan
from tlcomm_core.protocol.messages import Message

__all__ = ["Event", "MessageHeard", "OdometryReceived", "TaskChanged", "TimePassed"]


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
    """

    task: str
    plan: LocalPlan


@dataclass(frozen=True, slots=True)
class TimePassed:
    """The time that the brain had asked for has come, or any other."""


Event = OdometryReceived | MessageHeard | TaskChanged | TimePassed
