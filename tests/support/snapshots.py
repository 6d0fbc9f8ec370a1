"""Deep snapshots of a state machine, to compare before and after.

``snapshot``  everything that an object holds, as plain values
"""

from collections.abc import Mapping
from collections.abc import Set as AbstractSet
from typing import Any

__all__ = ["snapshot"]

_MACHINES = "tlcomm_core.protocol"


def snapshot(value: Any) -> Any:  # noqa: ANN401  # of anything at all
    """Return a deep copy of all mutable state; what is immutable stands for itself."""
    if isinstance(value, Mapping):
        return [(key, snapshot(item)) for key, item in value.items()]
    if isinstance(value, AbstractSet):
        return sorted(value)
    if isinstance(value, list | tuple):
        return [snapshot(item) for item in value]
    if type(value).__module__.startswith(_MACHINES) and hasattr(value, "__dict__"):
        return type(value), snapshot(vars(value))
    return value
