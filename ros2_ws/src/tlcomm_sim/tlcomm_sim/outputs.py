"""What the sim says and is told, as values.

``Tick``    leave to work up to a time, with what must have been received before
``Answer``  what agents and the recorder answer
``Output``  ``ShowClock``, ``Show``, ``TickAgent``, ``TickRecorder``, ``Warn`` or ``Leave``
"""

from dataclasses import dataclass

from tlcomm_core.world.observation import Observation

__all__ = [
    "Answer",
    "Leave",
    "Output",
    "Show",
    "ShowClock",
    "Tick",
    "TickAgent",
    "TickRecorder",
    "Warn",
]


@dataclass(frozen=True, slots=True)
class Tick:
    """Leave to work up to a time. Counts are of messages since the start.

    Attributes:
        sequence: number of the tick, from 1.
        time_ns: up to when.
        odometry_count: to an agent: of its own odometry; to the recorder: of everybody's.
        connectivity_count: of connectivity.
        clock_count: of clock.
        map_count: of the map.
        agent_counts: per agent, to an agent: of team messages that have arrived by ``time_ns``;
            to the recorder: of all that the agent has published.
        stop: the run is over.
        reading_count: to an agent: of its own readings; to the recorder: of everybody's.
    """

    sequence: int
    time_ns: int
    odometry_count: int
    connectivity_count: int
    clock_count: int
    map_count: int
    agent_counts: tuple[int, ...]
    stop: bool = False
    reading_count: int = 0


@dataclass(frozen=True, slots=True)
class Answer:
    """What an agent or the recorder answers; the fields are ``TickReply``'s."""

    name: str
    sequence: int
    ready: bool
    next_need_ns: int | None = None
    team_messages: int = 0
    commands: int = 0
    published: int = 0
    meetings_ended: int = 0
    measured_at: str = ""


@dataclass(frozen=True, slots=True)
class ShowClock:
    """Publish the simulation time."""

    time_ns: int


@dataclass(frozen=True, slots=True)
class Show:
    """Publish what the world shows."""

    observation: Observation


@dataclass(frozen=True, slots=True)
class TickAgent:
    """Tick an agent."""

    agent: str
    tick: Tick


@dataclass(frozen=True, slots=True)
class TickRecorder:
    """Tick the recorder."""

    tick: Tick


@dataclass(frozen=True, slots=True)
class Warn:
    """Tell the user."""

    text: str


@dataclass(frozen=True, slots=True)
class Leave:
    """The run is over and everybody has been told."""


Output = ShowClock | Show | TickAgent | TickRecorder | Warn | Leave
