"""One run of a comparison: what it needs and what it leaves.

``Job``       what is run
``Finished``  the files of a run
``Failed``    why there is no run
``TRACE``     name of the file that figures are drawn from
``AUDIT``     name of the file that says what the independent audit found
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from tlcomm_core.method import Method

__all__ = ["AUDIT", "TRACE", "Failed", "Finished", "Job", "Outcome"]

TRACE: Final = "trace.json"
AUDIT: Final = "audit.json"


@dataclass(frozen=True, slots=True)
class Job:
    """One run; all that it needs, so that it can be done on another machine.

    Attributes:
        folder: where its files belong, relative to the comparison's.
        scenario: text, perturbed and with every default filled in.
        method: of coordination.
        solver: name of the solver of the rounds, as far as the method leaves the choice.
        seed: of the repetition, and of all that is random.
        until_s: simulated time at its end.
        effort: about how long it takes, in no unit.
        value: of what is swept; ``None`` without a sweep.
        is_drawn: whether figures need more of it than its results.
    """

    folder: str
    scenario: str
    method: Method
    solver: str
    seed: int
    until_s: float
    effort: float
    value: float | None = None
    is_drawn: bool = False


@dataclass(frozen=True, slots=True)
class Finished:
    """What a run leaves.

    Attributes:
        files: texts by file name.
    """

    files: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Failed:
    """Why there is no run.

    Attributes:
        reason: one line.
    """

    reason: str


Outcome = Finished | Failed
