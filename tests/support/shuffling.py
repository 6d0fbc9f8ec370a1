"""Lock step in which the members of an instant are ticked in any order.

``Shuffling``  such orders, seeded and counted
"""

import random

import pytest

from tlcomm_core.world.lockstep import LockStep, Step

__all__ = ["Shuffling"]


class Shuffling:
    """Any orders among those who are ticked at one instant.

    Attributes:
        count: how many orders weren't the usual one.
    """

    def __init__(self, monkeypatch: pytest.MonkeyPatch, seed: int = 7) -> None:
        """Shuffle from now on, until the test ends."""
        self.count = 0
        self._rng = random.Random(seed)  # noqa: S311 (any order will do)
        usual = LockStep.next_step

        def next_step(lockstep: LockStep) -> Step | None:
            step = usual(lockstep)
            return None if step is None else self._shuffled(step)

        monkeypatch.setattr(LockStep, "next_step", next_step)

    def _shuffled(self, step: Step) -> Step:
        ticked = tuple(self._rng.sample(step.ticked, len(step.ticked)))
        self.count += ticked != step.ticked
        return Step(step.time_ns, step.observations, ticked, step.arrived)
