"""Message definitions: what a bag carries so that any reader can decode it.

``Definition``       a type's definition text and hash
``load_typestore``   the common interfaces and one package's own
``read_definition``  one type's definition
"""

from dataclasses import dataclass
from pathlib import Path

from rosbags.typesys import Stores, get_types_from_msg, get_typestore
from rosbags.typesys.store import Typestore

from tlcomm_core.errors import InputError

__all__ = ["Definition", "load_typestore", "read_definition"]

_PACKAGE = "tlcomm_msgs"


@dataclass(frozen=True, slots=True)
class Definition:
    """A message type as a bag describes it.

    Attributes:
        type: as ``package/msg/Name``.
        text: its definition and those of all types inside it (encoding ``ros2msg``).
        type_hash: its RIHS01 hash.
    """

    type: str
    text: str
    type_hash: str


def load_typestore(share: Path) -> Typestore:
    """Return ROS 2 Jazzy's common interfaces and those of ``tlcomm_msgs``.

    Args:
        share: the folder of ``tlcomm_msgs`` that holds ``msg/*.msg``.

    Raises:
        InputError: there are no message files.
    """
    paths = sorted((share / "msg").glob("*.msg"))
    if not paths:
        raise InputError(f"{str(share / 'msg')!r} holds no .msg files of {_PACKAGE}")
    store = get_typestore(Stores.ROS2_JAZZY)
    types = {}
    for path in paths:
        types.update(get_types_from_msg(path.read_text("utf-8"), f"{_PACKAGE}/msg/{path.stem}"))
    store.register(types)
    return store


def read_definition(store: Typestore, type_name: str) -> Definition:
    """Return the definition of one type in the store."""
    text, _ = store.generate_msgdef(type_name, ros_version=2)
    return Definition(type_name, text, store.hash_rihs01(type_name))
