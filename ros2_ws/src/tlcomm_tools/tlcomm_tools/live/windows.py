"""Which windows were kept, as they are decided.

``Windows``  told when the team is connected, it lists the windows
"""

from typing import Final

from tlcomm_core.units import nanoseconds
from tlcomm_core.world.observation import Connectivity
from tlcomm_tools.live.growing import Growing
from tlcomm_tools.mirror.window_watch import WindowWatch

__all__ = ["Windows"]


class Windows:
    """Lists the windows that are decided, in order."""

    def __init__(self, decided: Growing, period_s: float, duration_s: float) -> None:
        """Begin at time 0, with nobody connected.

        Args:
            decided: to be filled.
            period_s: T_c.
            duration_s: D_c.
        """
        self._decided: Final = decided
        self._watch: Final = WindowWatch(nanoseconds(period_s), nanoseconds(duration_s))
        self._missed = 0

    def follow(self, graph: Connectivity) -> None:
        """Take the radio graph from a time on; it comes at least once a second."""
        self._watch.observe(graph.stamp_ns, connected=graph.connected)
        self._list()

    def advance(self, now_ns: int) -> None:
        """Take that a time has come."""
        self._watch.advance(now_ns)
        self._list()

    def _list(self) -> None:
        while True:
            number = len(self._decided.items)
            is_kept = self._watch.is_kept(number)
            if not is_kept and self._watch.missed == self._missed:
                return
            self._missed += not is_kept
            self._decided.append({"round": number, "satisfied": is_kept})
