"""The message types that a file defines itself.

``make_typestore``  a store that decodes the messages of its channels
``decoding``        what goes wrong while they are decoded, in one line
"""

from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from rosbags.typesys import Stores, get_types_from_idl, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from tlcomm_core.errors import InputError
from tlcomm_tools.bag.container import Channel

__all__ = ["decoding", "make_typestore"]


def make_typestore(channels: Iterable[Channel]) -> Typestore:
    """Return the types of these channels, as the file itself defines them.

    Raises:
        InputError: a channel's messages have another encoding than CDR.
    """
    store = get_typestore(Stores.EMPTY)
    types = {}
    for channel in channels:
        if channel.encoding != "cdr":
            raise InputError(
                f"topic {channel.topic!r} is encoded as {channel.encoding!r}, expected 'cdr'"
            )
        if channel.definition_encoding == "ros2idl":
            types.update(get_types_from_idl(channel.definition))
        elif channel.type not in types:
            types.update(get_types_from_msg(channel.definition, channel.type))
    store.register(types)
    return store


@contextmanager
def decoding(path: Path) -> Iterator[None]:
    """Turn whatever fails in the block into one line that names the file.

    Decoders are made from the definitions that the file brings along, so a foreign or damaged one
    can fail in any way.

    Raises:
        InputError: something failed.
    """
    try:
        yield
    except InputError:
        raise
    except AttributeError as error:
        raise InputError(f"{str(path)!r} has messages of another version: {error}") from error
    except Exception as error:
        raise InputError(f"{str(path)!r} holds a message that can't be decoded: {error}") from error
