"""What an agent's brain asks its shell to do: immutable requests, in the imperative.

``Drive``           set the velocity
``SendMessage``     say something to whoever is in range
``ReportTask``      publish a ``TaskEvent``
``HoldStrategy``    publish the team strategy that this agent holds as agreed
``ReportEstimate``  publish what the agent takes the field to be
``SayEstimate``     say so to whoever is in range
``CountIgnored``    count a message that was late, duplicate, foreign or malformed
``Action``          any of them
``Fault``           what an agent copes with
"""

import re
from dataclasses import dataclass
from enum import IntEnum, StrEnum
from typing import Final

from tlcomm_core.protocol.actions import CountIgnored, HoldStrategy, SendMessage
from tlcomm_core.protocol.messages import EstimateExchange

__all__ = [
    "Action",
    "CountIgnored",
    "Drive",
    "Fault",
    "HoldStrategy",
    "ReportEstimate",
    "ReportTask",
    "SayEstimate",
    "SendMessage",
    "TaskEvent",
    "TaskEventKind",
]


class Fault(StrEnum):
    """What an agent copes with: the first key in the detail of a ``FAULT``."""

    FAILED = "action"
    """An action failed, and is begun anew."""
    DISPLACED = "displaced_m"
    """Something has put the agent so far off its way."""
    CUT_OFF = "cut_off_m"
    """The map keeps it so far from the place of meeting."""
    BLOCKED = "blocked"
    """It has no plan round what the map has closed."""
    INFEASIBLE = "infeasible"
    """Nobody can plan a meeting in the next window."""
    DISAGREEMENT = "agreement"
    """A meeting is over, or was left, without agreement on the next."""


_COPED_WITH: Final = tuple(f"{fault}=" for fault in Fault)


class TaskEventKind(IntEnum):
    """The kinds of ``tlcomm_msgs/TaskEvent``."""

    ACTION_STARTED = 1
    ACTION_FINISHED = 2
    MEETING_REACHED = 3
    MEETING_STARTED = 4
    MEETING_ENDED = 5
    TASK_SATISFIED = 6
    ROUND_AGREED = 7
    FAULT = 8
    REGION_VISITED = 9
    TASK_CHANGED = 10
    PLAN_CHANGED = 11


@dataclass(frozen=True, slots=True)
class TaskEvent:
    """What an agent did just now.

    Attributes:
        kind: what.
        region: where, or "" when at no region.
        action: with what action, or "".
        round: the round whose meeting it is at or heads for.
        plan_index: index in the local plan of the step under way or last done.
        detail: for people; machine-readable parts as ``key=value``.
    """

    kind: TaskEventKind
    region: str
    action: str
    round: int
    plan_index: int
    detail: str = ""

    @property
    def is_coped_with(self) -> bool:
        """Whether it is a fault after which the agent goes on."""
        is_known = self.detail.startswith(_COPED_WITH)
        return self.is_failed_attempt or (self.kind is TaskEventKind.FAULT and is_known)

    @property
    def is_disagreement(self) -> bool:
        """Whether a meeting is over, or was left, without agreement on the next."""
        return self.kind is TaskEventKind.FAULT and self.detail.startswith(f"{Fault.DISAGREEMENT}=")

    @property
    def disputed_round(self) -> int | None:
        """The round on which a meeting has ended without agreement; ``None`` for other events."""
        found = re.search(r"\bround=(\d+)", self.detail) if self.is_disagreement else None
        return None if found is None else int(found[1])

    @property
    def is_failed_attempt(self) -> bool:
        """Whether an action has failed, to be begun anew."""
        return self.kind is TaskEventKind.FAULT and bool(self.action)


@dataclass(frozen=True, slots=True)
class Drive:
    """Set the velocity; it holds until the next one."""

    linear_mps: float
    angular_radps: float


@dataclass(frozen=True, slots=True)
class ReportTask:
    """Publish what was done."""

    event: TaskEvent


@dataclass(frozen=True, slots=True)
class ReportEstimate:
    """Publish what the agent takes the field to be.

    Attributes:
        value: the estimate.
        last_measurement: the agent's own last; ``None`` if it has measured nothing yet.
    """

    value: float
    last_measurement: float | None


@dataclass(frozen=True, slots=True)
class SayEstimate:
    """Say to whoever is in range what the agent takes the field to be."""

    message: EstimateExchange


Action = (
    Drive | SendMessage | ReportTask | HoldStrategy | ReportEstimate | SayEstimate | CountIgnored
)
