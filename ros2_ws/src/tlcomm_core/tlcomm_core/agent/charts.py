"""The maps that an agent knows.

``Charts``  each by the time from which it holds
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.workspace.atlas import Atlas

__all__ = ["Charts"]

# Others may hear of a map, or leave a meeting and offer at the next, earlier or later.
_KEPT: Final = 8


class Charts:
    """The maps that an agent knows, each by the time from which it holds (ns).

    The scenario's own holds from 0 on. Offers for one round are made between two departures from
    meetings, each with the latest map that its maker knew; so whoever forgets maps at departures
    only, and keeps the latest few then, knows what every offer was made with.
    """

    def __init__(self, atlas: Atlas) -> None:
        """Know the scenario's map."""
        # Of equal cells the first map is the one that all go by: it knows the obstacles' shapes.
        self._first: Final = atlas
        self._atlases: dict[int, Atlas] = {0: atlas}

    @property
    def latest_ns(self) -> int:
        """The time from which the latest map holds."""
        return next(reversed(self._atlases))

    @property
    def latest(self) -> Atlas:
        """Travel times on the latest map."""
        return self._atlases[self.latest_ns]

    def atlas(self, map_ns: int) -> Atlas | None:
        """Return travel times on the map that holds from a time on; ``None`` if it isn't known."""
        return self._atlases.get(map_ns)

    def take(self, map_ns: int, free: NDArray[np.bool_]) -> bool:
        """Take a map, unless it isn't later than the latest; return whether it is.

        Args:
            map_ns: the time from which it holds.
            free: which cells are free, bool[rows, columns], as on the scenario's map.
        """
        if map_ns <= self.latest_ns:
            return False
        self._atlases[map_ns] = self._first.on(free)
        return True

    def forget(self) -> None:
        """Forget what no offer for the next round can be made with."""
        for map_ns in list(self._atlases)[:-_KEPT]:
            del self._atlases[map_ns]
