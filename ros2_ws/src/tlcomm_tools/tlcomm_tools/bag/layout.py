"""Where numbers lie in messages of one type and of one size, so that many are read at once.

``Layout``  of a type, as a file defines it, and of the messages that are like one of them

A message in CDR is a sequence of fields, each aligned to its size. Where a field lies follows from
the definition and from the lengths of the strings and sequences before it. So messages that agree
in these lengths agree in where everything lies.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final, Self

import numpy as np
from numpy.typing import NDArray
from rosbags.interfaces import Nodetype
from rosbags.typesys.store import Typestore

__all__ = ["Layout"]

_HEAD: Final = 4
# The second byte of a message's head says so; nobody writes any other.
_LITTLE_ENDIAN: Final = 1
_WORD: Final = 4
_KINDS: Final = {
    "bool": "u1", "byte": "u1", "char": "u1", "uint8": "u1", "int8": "i1",
    "uint16": "u2", "int16": "i2", "uint32": "u4", "int32": "i4", "uint64": "u8", "int64": "i8",
    "float32": "f4", "float64": "f8",
}  # fmt: skip


@dataclass(frozen=True, slots=True)
class Layout:
    """Of a type, and of the messages that are like one of them.

    Attributes:
        size: of such a message in bytes.
        places: of numbers: offset and kind, by the names on the way there, with dots between.
        lengths: offsets of the lengths of strings and sequences.
    """

    size: int
    places: dict[str, tuple[int, str]]
    lengths: tuple[int, ...]

    @classmethod
    def of(cls, store: Typestore, type_name: str, sample: bytes) -> Self | None:
        """Return the layout of messages like a sample; none if it can't be followed.

        Args:
            store: with the definition.
            type_name: of the messages.
            sample: one of them.
        """
        if len(sample) < _HEAD or sample[1] != _LITTLE_ENDIAN:
            return None
        walk = _Walk(store, sample)
        try:
            walk.message(type_name, "")
        except _PathlessError:
            return None
        return cls(len(sample), walk.places, tuple(walk.lengths))

    def columns(
        self, messages: Sequence[bytes], names: Sequence[str]
    ) -> tuple[NDArray[np.generic], ...] | None:
        """Return the numbers of some names, by message; none if one is laid out otherwise.

        Args:
            messages: of the type; at least one.
            names: which numbers.
        """
        if any(len(data) != self.size for data in messages):
            return None
        table = np.frombuffer(b"".join(messages), dtype=np.uint8).reshape(-1, self.size)
        heads = [table[:, 1:2], *(table[:, at : at + _WORD] for at in self.lengths)]
        if any((head != head[0]).any() for head in heads) or not self.places.keys() >= set(names):
            return None
        found = []
        for name in names:
            at, kind = self.places[name]
            width = int(kind[1])
            found.append(np.ascontiguousarray(table[:, at : at + width]).view(f"<{kind}")[:, 0])
        return tuple(found)


class _PathlessError(Exception):
    """A message can't be followed by its definition."""


class _Walk:
    """Follows a message by its definition."""

    def __init__(self, store: Typestore, sample: bytes) -> None:
        self.places: dict[str, tuple[int, str]] = {}
        self.lengths: list[int] = []
        self._store = store
        self._sample = sample
        self._at = _HEAD

    def message(self, type_name: str, path: str) -> None:
        """Go past a message."""
        _, fields = self._store.fielddefs[type_name]
        for name, description in fields:
            own = f"{path}{name}"
            match description:
                case (Nodetype.NAME, str(inner)):
                    self.message(inner, f"{own}.")
                case (Nodetype.BASE, (str(base), _)):
                    self._base(base, own)
                case (Nodetype.ARRAY, ((Nodetype.BASE, (str(base), _)), int(count))):
                    self._items(base, count)
                case _:
                    # Sequences are what makes sizes differ.
                    raise _PathlessError

    def _base(self, base: str, path: str) -> None:
        if base == "string":
            self._text()
            return
        kind = self._kind(base)
        self._align(int(kind[1]))
        self.places[path] = (self._at, kind)
        self._skip(int(kind[1]))

    def _items(self, base: str, count: int) -> None:
        width = int(self._kind(base)[1])
        self._align(width)
        self._skip(count * width)

    def _text(self) -> None:
        self._align(_WORD)
        self.lengths.append(self._at)
        length = int.from_bytes(self._sample[self._at : self._at + _WORD], "little")
        self._skip(_WORD + length)

    def _kind(self, base: str) -> str:
        if base not in _KINDS:
            raise _PathlessError
        return _KINDS[base]

    def _align(self, width: int) -> None:
        self._at += -(self._at - _HEAD) % width

    def _skip(self, count: int) -> None:
        self._at += count
        if self._at > len(self._sample):
            raise _PathlessError
