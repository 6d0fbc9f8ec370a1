"""What a bag holds of what agents were told and did.

``Recording``       all of it, each list in the order of time
``Said``            a team message, with its time
``Commanded``       a velocity command, with its time
``MapShown``        a map, with its time
``read_recording``  from a bag
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from operator import attrgetter
from pathlib import Path
from typing import Final, Protocol

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.agent.actions import Drive
from tlcomm_core.errors import InputError
from tlcomm_core.protocol.messages import TeamMessage
from tlcomm_core.world.observation import Reading
from tlcomm_tools.bag.container import Channel
from tlcomm_tools.bag.messages import BagMessage, read_messages
from tlcomm_tools.bag.reader import RecordedRun, read_run
from tlcomm_tools.bag.topics import TEAM_TOPICS, split_topic
from tlcomm_tools.wire import stamp_ns
from tlcomm_tools.wire_messages import read_command, read_map, read_reading, read_team_message

__all__ = ["Commanded", "MapShown", "Recording", "Said", "read_recording"]


class _Stamped(Protocol):
    @property
    def stamp_ns(self) -> int: ...


_TOPICS: Final = ("cmd_vel", "map", "reading", *TEAM_TOPICS)


@dataclass(frozen=True, slots=True)
class Said:
    """A team message that an agent said."""

    stamp_ns: int
    agent: str
    message: TeamMessage


@dataclass(frozen=True, slots=True)
class Commanded:
    """A velocity that an agent commanded."""

    stamp_ns: int
    agent: str
    drive: Drive


@dataclass(frozen=True, slots=True)
class MapShown:
    """Which cells are free from ``stamp_ns`` on, bool[rows, columns]."""

    stamp_ns: int
    free: NDArray[np.bool_]


@dataclass(slots=True)
class Recording:
    """What agents were told and did.

    Attributes:
        run: the run's records.
        said: by all agents, on each topic in the order of saying.
        commanded: by all agents.
        maps: shown to all agents.
        readings: of all agents.
        topics: those that are in the bag, with messages or without.
    """

    run: RecordedRun
    said: list[Said] = field(default_factory=list)
    commanded: list[Commanded] = field(default_factory=list)
    maps: list[MapShown] = field(default_factory=list)
    readings: list[Reading] = field(default_factory=list)
    topics: frozenset[str] = frozenset()

    @property
    def end_ns(self) -> int:
        """The last instant at which anything happened."""
        records = self.run.records
        return max(
            _last_ns(records.odometry),
            _last_ns(records.connectivity),
            _last_ns(records.tasks),
            _last_ns(records.strategies),
            _last_ns(records.estimates),
            _last_ns(self.said),
            _last_ns(self.commanded),
            _last_ns(self.maps),
            _last_ns(self.readings),
        )


def read_recording(path: Path) -> Recording:
    """Read a run folder, a bag folder or an MCAP file.

    Raises:
        InputError: there is no bag, none of a tlcomm run, or a message in it can't be used.
    """
    run, bag = read_run(path), read_messages(path, _is_wanted)
    recording = Recording(run, topics=bag.topics)
    for message in bag.messages:
        try:
            _take(recording, message)
        except (AttributeError, TypeError, ValueError) as error:
            # The file's own definition of a type may be another than ours.
            topic = f"/{message.agent}/{message.topic}".replace("//", "/")
            raise InputError(f"a message on {topic!r} can't be used: {error}") from error
    for entries in (recording.said, recording.commanded, recording.maps, recording.readings):
        entries.sort(key=attrgetter("stamp_ns"))
    return recording


def _last_ns(entries: Sequence[_Stamped]) -> int:
    return entries[-1].stamp_ns if entries else 0


def _is_wanted(channel: Channel) -> bool:
    return split_topic(channel.topic)[1] in _TOPICS


def _take(recording: Recording, message: BagMessage) -> None:
    agent, content = message.agent, message.content
    time_ns = stamp_ns(content.header.stamp)
    match message.topic:
        case "cmd_vel":
            recording.commanded.append(Commanded(time_ns, agent, read_command(content)))
        case "map":
            recording.maps.append(MapShown(time_ns, read_map(content)))
        case "reading":
            recording.readings.append(read_reading(content))
        case topic:
            recording.said.append(Said(time_ns, agent, read_team_message(content, topic)))
