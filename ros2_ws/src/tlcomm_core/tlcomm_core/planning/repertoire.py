"""What an agent can do, where, and after what.

- ``Condition``   what an action needs first
- ``Repertoire``  an agent's actions, with the memory that their conditions ask for
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.errors import LocalMisuseError

__all__ = ["Condition", "Repertoire"]

Ints = NDArray[np.int64]


@dataclass(frozen=True, slots=True)
class Condition:
    """What an action needs first.

    Attributes:
        at: it is possible in these regions only; None for any.
        after: each of these must have been performed since the action itself was last.
    """

    at: frozenset[str] | None = None
    after: frozenset[str] = frozenset()


_UNCONDITIONAL: Final = Condition()


class Repertoire:
    """An agent's actions by number; 0 is none, the paper's a_0.

    What has been performed is remembered only as far as conditions ask for it: the *memory* is a
    set of bits, one for each pair of an action and another that it comes after.

    Attributes:
        actions: names; index 0 is None.
        durations_s: by action from number 1 on.
        memories: number of values that a memory can have; the first is 0.
    """

    def __init__(
        self, durations_s: Mapping[str, float], conditions: Mapping[str, Condition]
    ) -> None:
        """Number the actions in their order.

        Args:
            durations_s: duration of each action, ≥ 0.
            conditions: of those that have any.

        Raises:
            LocalMisuseError: a duration is negative, or a condition names an unknown action.
        """
        for action, duration_s in durations_s.items():
            if not duration_s >= 0.0:
                message = f"duration of action {action!r} is {duration_s!r}, expected ≥ 0"
                raise LocalMisuseError(message)
        self.actions: Final[tuple[str | None, ...]] = (None, *durations_s)
        self.durations_s: Final = tuple(durations_s.values())
        self._conditions: Final = [conditions.get(name, _UNCONDITIONAL) for name in durations_s]
        self._needs: Final = np.zeros(len(self.actions), dtype=np.int64)
        self._adds: Final = np.zeros(len(self.actions), dtype=np.int64)
        self.memories: Final = self._number_pairs()

    def _number_pairs(self) -> int:
        bit = 1
        for action, condition in enumerate(self._conditions, start=1):
            for other in sorted(condition.after):
                if other not in self.actions:
                    message = f"action {self.actions[action]!r} comes after unknown {other!r}"
                    raise LocalMisuseError(message)
                self._needs[action] += bit
                self._adds[self.actions.index(other)] += bit
                bit *= 2
        return bit

    def possible_in(self, regions: frozenset[str]) -> NDArray[np.bool_]:
        """Return which actions are possible in a place in some regions, bool[A + 1]."""
        ats = [condition.at for condition in self._conditions]
        here = [at is None or not at.isdisjoint(regions) for at in ats]
        return np.array([True, *here], dtype=np.bool_)

    def possible_after(self, memory: Ints) -> NDArray[np.bool_]:
        """Return which actions are possible with each memory, bool[K, A + 1]."""
        possible: NDArray[np.bool_] = (memory[:, None] & self._needs) == self._needs
        return possible

    def memory_after(self, memory: Ints) -> Ints:
        """Return the memory after each action with each memory before, int[K, A + 1]."""
        after: Ints = (memory[:, None] & ~self._needs) | self._adds
        return after
