"""The message types that a file defines itself.

``make_typestore``  a store that decodes the messages of its channels
"""

from collections.abc import Iterable

from rosbags.typesys import Stores, get_types_from_idl, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from tlcomm_core.errors import InputError
from tlcomm_tools.bag.container import Channel

__all__ = ["make_typestore"]


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
