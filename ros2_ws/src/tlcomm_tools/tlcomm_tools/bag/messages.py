"""Any of a bag's messages, decoded by the definitions inside.

``BagMessage``     one of them
``DecodedBag``     those on some topics
``read_messages``  reads them
``using``          what goes wrong while one of them is used, in one line
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from tlcomm_core.errors import InputError
from tlcomm_core.wire.fields import WireError
from tlcomm_tools.bag.container import Channel, Container, read_container
from tlcomm_tools.bag.reader import find_files
from tlcomm_tools.bag.topics import split_topic
from tlcomm_tools.bag.typestore import decoding, make_typestore
from tlcomm_tools.wire import DecodedMessage

__all__ = ["BagMessage", "DecodedBag", "read_messages", "using"]


@dataclass(frozen=True, slots=True)
class BagMessage:
    """A message.

    Attributes:
        agent: whose topic it is on, or "".
        topic: that topic's own name.
        content: as decoded.
    """

    agent: str
    topic: str
    content: DecodedMessage


@dataclass(frozen=True, slots=True)
class DecodedBag:
    """A bag's messages on some topics.

    Attributes:
        topics: all that the bag has, by name, with messages or without.
        messages: in the order of its files.
    """

    topics: frozenset[str]
    messages: tuple[BagMessage, ...]


def read_messages(path: Path, wanted: Callable[[Channel], bool]) -> DecodedBag:
    """Read a run folder, a bag folder or an MCAP file; a damaged one as far as it goes.

    Args:
        path: the folder or file.
        wanted: which channels to decode.

    Raises:
        InputError: there is no bag, or a message can't be decoded.
    """
    topics: set[str] = set()
    messages: list[BagMessage] = []
    for file in find_files(path):
        container = read_container(file, wanted)
        topics.update(channel.topic for channel in container.channels.values())
        with decoding(file):
            messages += _decoded(container, wanted)
        if container.damage:
            break
    return DecodedBag(frozenset(topics), tuple(messages))


@contextmanager
def using(message: BagMessage) -> Iterator[None]:
    """Turn what fails in the block into one line that names the message's topic.

    The file's own definition of a type may be another than ours.

    Raises:
        InputError: something failed.
    """
    try:
        yield
    except (WireError, AttributeError, TypeError, ValueError) as error:
        topic = f"/{message.agent}/{message.topic}".replace("//", "/")
        raise InputError(f"a message on {topic!r} can't be used: {error}") from error


def _decoded(container: Container, wanted: Callable[[Channel], bool]) -> Iterator[BagMessage]:
    decode = make_typestore(filter(wanted, container.channels.values())).deserialize_cdr
    for number, _, data in container.messages:
        channel = container.channels[number]
        agent, suffix = split_topic(channel.topic)
        yield BagMessage(agent, suffix, decode(data, channel.type))
