"""What every member knows of the team beforehand.

``Team``          names, range, meeting windows, and how often unanswered messages are repeated
``OnInfeasible``  what it does when a round has no admissible meeting
"""

from dataclasses import dataclass
from enum import Enum

from tlcomm_core.game.candidates import ROUNDING_S
from tlcomm_core.game.rules import PLAIN_RULES, Rules
from tlcomm_core.game.solver import BEST_RESPONSE, Solver

__all__ = ["OnInfeasible", "Team"]


class OnInfeasible(Enum):
    """What the team does when a round has no admissible meeting."""

    WAIT = "wait"
    """It stays together where it is until that window has been kept, and plans anew then."""
    SKIP = "skip"
    """It gives that window up and meets in the one after it; if that can't be either, it waits."""
    STOP = "stop"
    """The run ends, and says who can't meet and why."""


@dataclass(frozen=True, slots=True)
class Team:
    """The team's common ground.

    Attributes:
        members: all agents' names.
        planned_range_m: within which two members hear each other although each may be off its place
            by its tolerance.
        period_s: T_c.
        duration_s: D_c.
        retry_s: a message not known to be superseded is repeated after this time, and then each
            time after twice as long until there is something new to say.
        longest_retry_s: the longest of these times.
        patience_s: the same while members are missing.
        linger_s: after the meeting, whoever holds what a neighbour may lack stays for so long.
        solver: how next meetings are found.
        max_iterations: K of Algorithm 1.
        rules: what the places of meetings must be, beside connected.
        margin_s: how long before its window's end a meeting begins at the latest.
        on_infeasible: what to do when a round has no admissible meeting.
        clearance_m: how far from obstacles members see each other for sure, although each may be
            off its place; ``None`` if their radios don't need to see.
        stride: by how many windows each of its meetings is later than the one before.
    """

    members: frozenset[str]
    planned_range_m: float
    period_s: float
    duration_s: float
    solver: Solver = BEST_RESPONSE
    retry_s: float = 0.0125
    longest_retry_s: float = 0.1
    patience_s: float = 1.6
    linger_s: float = 0.5
    max_iterations: int = 1000
    rules: Rules = PLAIN_RULES
    margin_s: float = ROUNDING_S
    on_infeasible: OnInfeasible = OnInfeasible.STOP
    clearance_m: float | None = None
    stride: int = 1

    def opens_s(self, round_: int) -> float:
        """Return when a round's window opens, r·T_c."""
        return round_ * self.period_s

    def window_s(self, round_: int) -> tuple[float, float]:
        """Return a round's window [r·T_c, (r+1)·T_c)."""
        return self.opens_s(round_), self.opens_s(round_ + 1)

    def planned_in(self, round_: int) -> int:
        """Return the window of the meeting at which a round is planned; 0 is that at t = 0."""
        return max(0, round_ - self.stride)

    @property
    def most_windows(self) -> int:
        """How many windows ahead a meeting may be planned."""
        return 2 if self.on_infeasible is OnInfeasible.SKIP else 1

    def horizon_s(self, window: int, departure_s: float) -> float:
        """Return how far offers look ahead from the departure: to the end of what may be planned.

        Args:
            window: of the meeting that they are made at.
            departure_s: when that ends.
        """
        return self.opens_s(window + 1 + self.most_windows) - departure_s

    def confirmable_until_s(self, round_: int) -> float:
        """Return until when a round may be confirmed by an agent.

        That is D_c into the window after that in which it is planned: its own, if the team meets in
        every window. Then every meeting that began in the window before has lasted for D_c, and
        T_c − D_c are left to get to the places of another in this one.
        """
        return self.opens_s(self.planned_in(round_) + 1) + self.duration_s
