"""What every member knows of the team beforehand.

``Team``  names, range, meeting windows, and how often unanswered messages are repeated
"""

from dataclasses import dataclass

from tlcomm_core.game.candidates import ROUNDING_S
from tlcomm_core.game.rules import PLAIN_RULES, Rules
from tlcomm_core.game.solver import DEFAULT, Solver

__all__ = ["Team"]


@dataclass(frozen=True, slots=True)
class Team:
    """The team's common ground.

    Attributes:
        members: all agents' names.
        planned_range_m: within which two members hear each other although each may be off its place
            by its tolerance.
        period_s: T_c.
        duration_s: D_c.
        retry_s: a message not known to be superseded is repeated after this time.
        patience_s: while members are missing, repetitions become rarer up to this interval.
        solver: how next meetings are found.
        max_iterations: K of Algorithm 1.
        rules: what the places of meetings must be, beside connected.
        margin_s: how long before its window's end a meeting begins at the latest.
    """

    members: frozenset[str]
    planned_range_m: float
    period_s: float
    duration_s: float
    solver: Solver = DEFAULT
    retry_s: float = 0.1
    patience_s: float = 1.6
    max_iterations: int = 1000
    rules: Rules = PLAIN_RULES
    margin_s: float = ROUNDING_S

    def opens_s(self, round_: int) -> float:
        """Return when a round's window opens, r·T_c."""
        return round_ * self.period_s

    def window_s(self, round_: int) -> tuple[float, float]:
        """Return a round's window [r·T_c, (r+1)·T_c)."""
        return self.opens_s(round_), self.opens_s(round_ + 1)
