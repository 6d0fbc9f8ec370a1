"""Fields that messages have in common, validated.

``decode_stamp``         nanoseconds of a stamp
``finite``, ``bound``    numbers that can be used
``name``, ``names``      names of sensible length
``bounded``              collections of sensible size
``WireError``            why a message is refused
"""

import math
from collections.abc import Collection
from typing import Any, Final, TypeVar

from tlcomm_core.errors import TlcommError
from tlcomm_core.units import NANOSECONDS_PER_SECOND

__all__ = [
    "MAX_AGENTS",
    "WireError",
    "bound",
    "bounded",
    "decode_stamp",
    "finite",
    "name",
    "names",
]

MAX_AGENTS: Final = 1000
"""The most agents that a message may speak of."""

_MAX_NAME: Final = 255
_Items = TypeVar("_Items", bound=Collection[Any])


class WireError(TlcommError):
    """A message from outside that can't be used; the text says which field and why."""


def decode_stamp(stamp: Any) -> int:  # noqa: ANN401 (whoever made the message made its classes)
    """Return a stamp in nanoseconds.

    Raises:
        WireError: it is negative or malformed.
    """
    if stamp.sec < 0 or stamp.nanosec >= NANOSECONDS_PER_SECOND:
        raise WireError(f"stamp: {stamp.sec} s and {stamp.nanosec} ns is no time of a run")
    return int(stamp.sec) * NANOSECONDS_PER_SECOND + int(stamp.nanosec)


def finite(value: float, field: str) -> float:
    """Return a number if it is finite.

    Raises:
        WireError: it isn't; the text names the field.
    """
    if not math.isfinite(value):
        raise WireError(f"{field}: {value!r} isn't finite")
    return value


def bound(value: float) -> float:
    """Return a bound from below, which is −inf where nothing is proven."""
    return value if value == -math.inf else finite(value, "bound")


def name(value: str, field: str) -> str:
    """Return a name of a sensible length.

    Raises:
        WireError: it is empty or too long.
    """
    if not 0 < len(value) <= _MAX_NAME:
        raise WireError(f"{field}: a name has 1 to {_MAX_NAME} characters, not {len(value)}")
    return value


def names(values: Collection[str], field: str) -> tuple[str, ...]:
    """Return names, of sensible length and number.

    Raises:
        WireError: one of them or their number isn't.
    """
    return tuple(name(value, field) for value in bounded(values, MAX_AGENTS, field))


def bounded(values: _Items, most: int, field: str) -> _Items:
    """Return a collection of at most ``most`` items.

    Raises:
        WireError: there are more.
    """
    if len(values) > most:
        raise WireError(f"{field}: {len(values)} are more than {most}")
    return values
