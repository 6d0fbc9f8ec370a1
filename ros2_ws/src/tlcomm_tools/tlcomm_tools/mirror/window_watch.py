"""Whether the team has been connected for long enough in each window, as a run goes on.

``WindowWatch``  told when the team is connected, it says which windows were kept and missed
"""

from typing import Final

from tlcomm_core.windows import TOLERANCE_NS

__all__ = ["WindowWatch"]


class WindowWatch:
    """Watches the windows [r·T_c, (r + 1)·T_c). Times go forward from call to call."""

    def __init__(self, period_ns: int, duration_ns: int) -> None:
        """Begin at time 0, with nobody connected.

        Args:
            period_ns: T_c.
            duration_ns: D_c.
        """
        self.period_ns: Final = period_ns
        self._least_ns: Final = duration_ns - TOLERANCE_NS
        self._since_ns: int | None = None
        self._kept: set[int] = set()
        self._judged = 0
        self.missed = 0

    def observe(self, stamp_ns: int, *, connected: bool) -> None:
        """Take the connectivity from a time on."""
        self.advance(stamp_ns)
        if not connected:
            self._since_ns = None
        elif self._since_ns is None:
            self._since_ns = stamp_ns

    def advance(self, now_ns: int) -> None:
        """Judge every window that is decided by now; count the missed in ``missed``."""
        if self._since_ns is not None:
            first, last = self._since_ns // self.period_ns, now_ns // self.period_ns
            self._kept.update(
                number
                for number in range(first, last + 1)
                if now_ns - max(self._since_ns, number * self.period_ns) >= self._least_ns
            )
        while self._is_decided(self._judged, now_ns):
            self.missed += self._judged not in self._kept
            self._kept.discard(self._judged - 1)
            self._judged += 1

    def _is_decided(self, number: int, now_ns: int) -> bool:
        closes_ns = (number + 1) * self.period_ns
        goes_on = self._since_ns is not None and self._since_ns < closes_ns
        return now_ns >= closes_ns and (number in self._kept or not goes_on)

    def is_kept(self, number: int) -> bool:
        """Return whether a window that isn't long over is kept so far."""
        return number in self._kept

    def connected_ns(self, now_ns: int) -> int:
        """Return for how long the whole team has been connected."""
        return 0 if self._since_ns is None else now_ns - self._since_ns
