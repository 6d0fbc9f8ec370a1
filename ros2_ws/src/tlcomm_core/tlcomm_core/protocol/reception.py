"""What becomes of a message that is heard.

``Reception``  accepted, or why it changed nothing
"""

from enum import Enum

__all__ = ["Reception"]


class Reception(Enum):
    """Accepted, or why the message changed nothing; the value is the reason that is counted."""

    ACCEPTED = "accepted"
    DUPLICATE = "duplicate"
    LATE = "late"
    EARLY = "early"
    FOREIGN = "foreign"
    UNNEEDED = "unneeded"
    MALFORMED = "malformed"
    CONFLICTING = "conflicting"
    OVERFLOWING = "overflowing"
