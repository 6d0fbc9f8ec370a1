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
from tlcomm_core.protocol.messages import TeamMessage
from tlcomm_core.protocol.topics import TEAM_TOPICS
from tlcomm_core.wire.fields import decode_stamp
from tlcomm_core.wire.team_messages import decode_message
from tlcomm_core.wire.world_messages import decode_command, decode_map, decode_reading
from tlcomm_core.world.observation import Reading
from tlcomm_tools.bag.container import Channel
from tlcomm_tools.bag.messages import BagMessage, read_messages, using
from tlcomm_tools.bag.reader import RecordedRun, read_run
from tlcomm_tools.bag.topics import split_topic

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
        with using(message):
            _take(recording, message)
    for entries in (recording.said, recording.commanded, recording.maps, recording.readings):
        entries.sort(key=attrgetter("stamp_ns"))
    return recording


def _last_ns(entries: Sequence[_Stamped]) -> int:
    return entries[-1].stamp_ns if entries else 0


def _is_wanted(channel: Channel) -> bool:
    return split_topic(channel.topic)[1] in _TOPICS


def _take(recording: Recording, message: BagMessage) -> None:
    agent, content = message.agent, message.content
    match message.topic:
        case "cmd_vel":
            drive, time_ns = Drive(*decode_command(content)), decode_stamp(content.header.stamp)
            recording.commanded.append(Commanded(time_ns, agent, drive))
        case "map":
            recording.maps.append(MapShown(*decode_map(content)))
        case "reading":
            recording.readings.append(decode_reading(content))
        case topic:
            said, time_ns = decode_message(content, topic)
            recording.said.append(Said(time_ns, agent, said))
