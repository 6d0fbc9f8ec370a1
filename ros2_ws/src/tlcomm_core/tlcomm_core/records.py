"""What a run leaves behind, as values: the same from a bag and from memory.

``TaskRecord``      an agent's ``TaskEvent`` with its time
``StrategyRecord``  a team strategy that an agent holds as agreed
``OfferRecord``     the plan that an agent laid open to agree on a round
``EstimateRecord``  what an agent takes the field to be
``SaidRecord``      that an agent said something
``HeardRecord``     that an agent's radio let it through to another
``RunRecords``      all of it, with the world's observations
``event_log``       the canonical text of a run's decisions, for comparing runs
"""

import json
from collections.abc import Iterator, Mapping
from dataclasses import asdict, dataclass, field

from tlcomm_core.agent.actions import TaskEvent
from tlcomm_core.agent.timing import RoundTiming
from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.game.strategy import TeamStrategy
from tlcomm_core.world.observation import Connectivity, Odometry

__all__ = [
    "EstimateRecord",
    "HeardRecord",
    "OfferRecord",
    "RunRecords",
    "SaidRecord",
    "StrategyRecord",
    "TaskRecord",
    "event_log",
]


@dataclass(frozen=True, slots=True)
class TaskRecord:
    """A task event."""

    stamp_ns: int
    agent: str
    event: TaskEvent


@dataclass(frozen=True, slots=True)
class StrategyRecord:
    """A team strategy held as agreed."""

    stamp_ns: int
    agent: str
    strategy: TeamStrategy


@dataclass(frozen=True, slots=True)
class OfferRecord:
    """The plan that an agent laid open to agree on a round, as it said it first."""

    stamp_ns: int
    agent: str
    round: int
    offer: MemberOffer


@dataclass(frozen=True, slots=True)
class EstimateRecord:
    """An agent's estimate of the field from ``stamp_ns`` on.

    Attributes:
        value: the estimate.
        last_measurement: the agent's own last; 0 and of no meaning if there was none.
        has_measurement: whether there was one.
    """

    stamp_ns: int
    agent: str
    value: float
    last_measurement: float
    has_measurement: bool


@dataclass(frozen=True, slots=True)
class SaidRecord:
    """That an agent said something, on one of the topics that agents talk on."""

    stamp_ns: int
    agent: str
    topic: str


@dataclass(frozen=True, slots=True)
class HeardRecord:
    """That an agent's radio let a message through, on which the agent then acted.

    Attributes:
        stamp_ns: when it acted.
        agent: who heard.
        sender: who said it.
        topic: on which of the sender's topics.
        said_ns: when, by the sender's clock.
    """

    stamp_ns: int
    agent: str
    sender: str
    topic: str
    said_ns: int


@dataclass(slots=True)
class RunRecords:
    """Everything that results and checks are computed from, each list in order of time.

    Attributes:
        estimates: whenever one has changed; of an agent without any estimate yet there is none.
        offers: each agent's own, once for each round that it was said for, unless it has changed.
        messages_sent: per agent, how many messages it said.
        bytes_sent: per agent, how long these were together, each as it is serialised.
        messages_undelivered: per agent, by reason, how many of the others' its radio didn't let
            through.
        said: by all agents.
        heard: by all agents.
        heard_until_ns: per agent, up to when ``heard`` has all that it heard; agents of whom that
            wasn't recorded are missing.
    """

    tasks: list[TaskRecord] = field(default_factory=list)
    strategies: list[StrategyRecord] = field(default_factory=list)
    timings: list[RoundTiming] = field(default_factory=list)
    odometry: list[Odometry] = field(default_factory=list)
    connectivity: list[Connectivity] = field(default_factory=list)
    estimates: list[EstimateRecord] = field(default_factory=list)
    offers: list[OfferRecord] = field(default_factory=list)
    messages_sent: dict[str, int] = field(default_factory=dict)
    bytes_sent: dict[str, int] = field(default_factory=dict)
    messages_undelivered: dict[str, Mapping[str, int]] = field(default_factory=dict)
    said: list[SaidRecord] = field(default_factory=list)
    heard: list[HeardRecord] = field(default_factory=list)
    heard_until_ns: dict[str, int] = field(default_factory=dict)


def event_log(records: RunRecords) -> Iterator[str]:
    """Yield one JSON line per decision, ordered by time and agent.

    Task events and held strategies are all that agents decide; equal logs mean equal runs. At one
    instant an agent's task events come before its strategies, each kind in the agent's own order:
    the log doesn't depend on how the messages of different agents and topics arrived at a recorder.
    """
    rows = [
        (record.stamp_ns, record.agent, "task", asdict(record.event)) for record in records.tasks
    ]
    rows += [
        (record.stamp_ns, record.agent, "team_strategy", asdict(record.strategy))
        for record in records.strategies
    ]
    rows.sort(key=lambda row: row[:3])
    for stamp_ns, agent, kind, value in rows:
        yield json.dumps({"stamp_ns": stamp_ns, "agent": agent, "type": kind, **value})
