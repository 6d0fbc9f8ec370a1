"""The command's exit statuses.

``Status``  each with its meaning
"""

from enum import IntEnum

__all__ = ["Status"]


class Status(IntEnum):
    """How the command ended."""

    FINE = 0
    PROPERTY_FAILED = 1
    BAD_INPUT = 2
    BROKEN = 3
    INTERRUPTED = 130
