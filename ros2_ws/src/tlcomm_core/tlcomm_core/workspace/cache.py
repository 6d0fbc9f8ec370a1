"""A cache of arrays that never grows beyond a number of bytes.

``BoundedCache``  least recently used out first
``Sized``         what it can hold
"""

from collections import OrderedDict
from collections.abc import Callable, Hashable
from typing import Generic, Protocol, TypeVar

__all__ = ["BoundedCache", "Sized"]


class Sized(Protocol):
    """A value that knows the size of its arrays."""

    @property
    def nbytes(self) -> int:
        """Size in bytes."""
        ...


_Key = TypeVar("_Key", bound=Hashable)
_Value = TypeVar("_Value", bound=Sized)


class BoundedCache(Generic[_Key, _Value]):
    """Values by key; the least recently used go when all together exceed ``max_bytes``.

    The latest value always stays, however large.
    """

    def __init__(self, max_bytes: int) -> None:
        """Start empty."""
        self._max_bytes = max_bytes
        self._bytes = 0
        self._values: OrderedDict[_Key, _Value] = OrderedDict()

    @property
    def is_half_full(self) -> bool:
        """Whether the values held take up half of the bytes allowed, or more."""
        return 2 * self._bytes >= self._max_bytes

    def __len__(self) -> int:
        """Return the number of values held."""
        return len(self._values)

    def get(self, key: _Key, make: Callable[[], _Value]) -> _Value:
        """Return the value of a key, made now if it isn't held."""
        if key in self._values:
            self._values.move_to_end(key)
            return self._values[key]
        value = make()
        self._values[key] = value
        self._bytes += value.nbytes
        while self._bytes > self._max_bytes and len(self._values) > 1:
            _, oldest = self._values.popitem(last=False)
            self._bytes -= oldest.nbytes
        return value
