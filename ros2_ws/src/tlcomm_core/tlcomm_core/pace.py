"""How simulated time goes on.

``Pace``        in lock step, or freely at a factor of real time
``LOCK_STEP``   the former
``parse_pace``  from what a user writes
"""

import math
from dataclasses import dataclass
from typing import Final

from tlcomm_core.errors import InputError

__all__ = ["LOCK_STEP", "Pace", "parse_pace"]


@dataclass(frozen=True, slots=True)
class Pace:
    """How simulated time goes on.

    Attributes:
        factor: simulated time per wall time; None in lock step.
    """

    factor: float | None

    @property
    def is_lockstep(self) -> bool:
        """Whether time waits for everybody."""
        return self.factor is None

    def __str__(self) -> str:
        """Return what ``parse_pace`` reads."""
        return "lockstep" if self.factor is None else repr(self.factor)


LOCK_STEP: Final = Pace(None)
"""Time waits for everybody."""


def parse_pace(text: str) -> Pace:
    """Read ``lockstep`` or a factor > 0; 1.0 is real time.

    Raises:
        InputError: it is neither.
    """
    if text == "lockstep":
        return LOCK_STEP
    try:
        factor = float(text)
    except ValueError:
        factor = math.nan
    if not 0.0 < factor < math.inf:
        raise InputError(f"pace: {text!r} is neither 'lockstep' nor a factor > 0")
    return Pace(factor)
