"""Actions that fail, at random.

``ActionFaults``  tells of each attempt at an action whether it fails
``fault_rng``     the randomness of one agent in one run
"""

from typing import Final

import numpy as np

__all__ = ["ActionFaults", "fault_rng"]


class ActionFaults:
    """Tells of each attempt at an action whether it fails."""

    def __init__(self, probability: float, rng: np.random.Generator) -> None:
        """Let attempts fail independently.

        Args:
            probability: of failing, in [0, 1].
            rng: drawn from once for each attempt, if any can fail.
        """
        self._probability: Final = probability
        self._rng: Final = rng

    def strikes(self) -> bool:
        """Return whether the attempt that is at its end has failed."""
        return self._probability > 0.0 and bool(self._rng.random() < self._probability)


def fault_rng(seed: int, agent: str) -> np.random.Generator:
    """Return an agent's own generator: what befalls it doesn't depend on what others do.

    Args:
        seed: the run's, ≥ 0.
        agent: its name.
    """
    return np.random.default_rng([seed, *agent.encode()])
