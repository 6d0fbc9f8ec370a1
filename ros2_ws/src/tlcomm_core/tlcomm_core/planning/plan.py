"""The local plan: a prefix and an endlessly repeated suffix of steps.

``PlanStep``   one state of the lasso: be in a region, perform an action or none
``LocalPlan``  the lasso, addressed by one running index through prefix and suffix
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

__all__ = ["LocalPlan", "PlanStep"]


@dataclass(frozen=True, slots=True)
class PlanStep:
    """One composed state ⟨π, a⟩ of the plan.

    Attributes:
        region: region to be in.
        location: the region's location (index into the grid's free cells); −1 if the map has
            closed it since the plan was made.
        action: action performed there, or ``None`` for a_0: to have arrived is all.
        duration_s: time that the step takes once there (0 for a mere visit, the idle time for
            staying put without an action).
        label: everything that is true there, the step's letter of the word.
        satisfies: whether completing this step takes an accepting transition of the task's
            automaton; for □◇φ^s it completes φ^s.
        wanted: where the step violates the soft task, the literals that this would have needed:
            atoms that should have been true and, with ! before them, false.
    """

    region: str
    location: int
    action: str | None
    duration_s: float
    label: frozenset[str]
    satisfies: bool
    wanted: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class LocalPlan:
    """An optimal accepting run τ = τ_pre (τ_suf)^ω of the product (Section IV-A).

    Attributes:
        prefix: steps executed once.
        suffix: steps repeated for ever, at least one of which satisfies.
        prefix_s: time from the start pose to the end of the prefix.
        suffix_s: time of one pass through the suffix, the makespan ξ_i for □◇φ^s whose suffix
            satisfies once.
        first_s: time from the start pose until the suffix satisfies for the first time.
        prefix_m: length of the way from the start pose to the end of the prefix.
        suffix_m: length of the way of one pass through the suffix.
        initial_label: what is true at the start, the first letter of the word.
        initial_wanted: what the soft task would have needed there, as in a step.
        weight_s: price of each violation in s; ``None`` without a soft task.
    """

    prefix: tuple[PlanStep, ...]
    suffix: tuple[PlanStep, ...]
    prefix_s: float
    suffix_s: float
    first_s: float
    prefix_m: float
    suffix_m: float
    initial_label: frozenset[str]
    initial_wanted: tuple[str, ...] = ()
    weight_s: float | None = None

    @property
    def prefix_violation(self) -> int:
        """Number of atoms that the soft task wants otherwise, from the start through the prefix."""
        return len(self.initial_wanted) + sum(len(step.wanted) for step in self.prefix)

    @property
    def suffix_violation(self) -> int:
        """Number of atoms that the soft task wants otherwise in one pass through the suffix."""
        return sum(len(step.wanted) for step in self.suffix)

    @property
    def prefix_price_s(self) -> float:
        """Price of what is violated from the start through the prefix."""
        return self.prefix_violation * (self.weight_s or 0.0)

    @property
    def suffix_price_s(self) -> float:
        """Price of what is violated in one pass through the suffix."""
        return self.suffix_violation * (self.weight_s or 0.0)

    @property
    def word(self) -> tuple[tuple[frozenset[str], ...], tuple[frozenset[str], ...]]:
        """The word that the plan reads: letters once, and letters for ever."""
        stem = (self.initial_label, *(step.label for step in self.prefix))
        return stem, tuple(step.label for step in self.suffix)

    def relocated(self, numbers: NDArray[np.int32]) -> "LocalPlan":
        """Return the plan on another map.

        Args:
            numbers: each location's number there, −1 if it is closed.
        """
        prefix, suffix = (
            tuple(replace(step, location=int(numbers[step.location])) for step in steps)
            for steps in (self.prefix, self.suffix)
        )
        return replace(self, prefix=prefix, suffix=suffix)

    def step(self, index: int) -> PlanStep:
        """Return step number ``index`` ≥ 0, counted on through every pass of the suffix."""
        if index < len(self.prefix):
            return self.prefix[index]
        return self.suffix[(index - len(self.prefix)) % len(self.suffix)]
