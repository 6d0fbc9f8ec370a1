"""What agents do that others can see: once as recorded, and once as it came out again.

``Output``            one of these things
``Failure``           that an agent can't go on
``output_of``         what an action of a brain's is
``hearing_of``        what an agent's radio has let through
``recorded_outputs``  what an agent did, by instants
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from tlcomm_core.agent.actions import (
    Action,
    CountIgnored,
    Drive,
    HoldStrategy,
    ReportEstimate,
    ReportTask,
    SayEstimate,
    SendMessage,
    TaskEvent,
)
from tlcomm_core.agent.member import Member
from tlcomm_core.game.strategy import TeamStrategy
from tlcomm_core.protocol.messages import TeamMessage
from tlcomm_core.protocol.topics import topic_of
from tlcomm_core.records import HeardRecord
from tlcomm_tools.verification.recording import Recording

__all__ = ["HEARING", "Failure", "Output", "hearing_of", "output_of", "recorded_outputs"]

HEARING: Final = "hearing"


@dataclass(frozen=True, slots=True)
class Failure:
    """Why an agent can't go on; never recorded."""

    reason: str

    def __str__(self) -> str:
        """Return the reason."""
        return self.reason


@dataclass(frozen=True, slots=True)
class Output:
    """Something that an agent published.

    Attributes:
        topic: on which of its topics; ``failure`` if it can't go on.
        value: what.
    """

    topic: str
    value: Drive | TaskEvent | TeamStrategy | ReportEstimate | TeamMessage | HeardRecord | Failure


def output_of(action: Action) -> Output | None:
    """Return what others see of an action; ``None`` for what an agent keeps to itself."""
    match action:
        case Drive():
            return Output("cmd_vel", action)
        case ReportTask(event):
            return Output("task_event", event)
        case HoldStrategy(strategy):
            return Output("team_strategy", strategy)
        case ReportEstimate():
            return Output("estimate", action)
        case SendMessage(message) | SayEstimate(message):
            return Output(topic_of(message), message)
        case CountIgnored():
            return None


def hearing_of(member: Member, now_ns: int) -> list[Output]:
    """Return what an agent's radio has let through to its last step, which was now."""
    return [
        Output(
            HEARING,
            HeardRecord(
                now_ns, member.name, own.message.sender, topic_of(own.message), own.said_ns
            ),
        )
        for own in member.heard
    ]


def recorded_outputs(recording: Recording, agent: str) -> dict[int, list[Output]]:
    """Return what an agent did at each instant (ns) at which it did anything, in order of time.

    What it did at one instant is in order on each topic, and topics are in no order.
    """
    found: dict[int, list[Output]] = {}
    for time_ns, whose, output in _recorded(recording):
        if whose == agent:
            found.setdefault(time_ns, []).append(output)
    return dict(sorted(found.items()))


def _recorded(recording: Recording) -> Iterator[tuple[int, str, Output]]:
    """Yield when who did what."""
    records = recording.run.records
    for command in recording.commanded:
        yield command.stamp_ns, command.agent, Output("cmd_vel", command.drive)
    for task in records.tasks:
        yield task.stamp_ns, task.agent, Output("task_event", task.event)
    for held in records.strategies:
        yield held.stamp_ns, held.agent, Output("team_strategy", held.strategy)
    for own in records.estimates:
        report = ReportEstimate(own.value, own.last_measurement if own.has_measurement else None)
        yield own.stamp_ns, own.agent, Output("estimate", report)
    for heard in records.heard:
        yield heard.stamp_ns, heard.agent, Output(HEARING, heard)
    for said in recording.said:
        yield said.stamp_ns, said.agent, Output(topic_of(said.message), said.message)
