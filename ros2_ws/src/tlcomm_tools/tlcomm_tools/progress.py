"""Progress on standard error.

``Bar``       a bar on a terminal, a line now and then elsewhere
``Progress``  that of a run
"""

import sys
import time
from collections.abc import Callable
from types import TracebackType
from typing import Self, TextIO

from tlcomm_core.method import Method

__all__ = ["Bar", "Progress"]

_BAR_CELLS = 24
_BAR_PERIOD_S = 0.1
_LINE_PERIOD_S = 5.0


class Bar:
    """Shows a share and a text: on a terminal always the last, elsewhere a line now and then."""

    def __init__(
        self, stream: TextIO | None = None, clock: Callable[[], float] = time.monotonic
    ) -> None:
        """Start the clock.

        Args:
            stream: where to; by default standard error.
            clock: wall time in seconds.
        """
        self._stream = sys.stderr if stream is None else stream
        self._clock = clock
        self._is_bar = self._stream.isatty()
        self._period_s = _BAR_PERIOD_S if self._is_bar else _LINE_PERIOD_S
        self._shown_s = self._started_s = clock()
        self._width = 0

    @property
    def elapsed_s(self) -> float:
        """Wall time since the clock was started."""
        return self._clock() - self._started_s

    def is_due(self) -> bool:
        """Tell whether it is time to show something; if so, the next time is a period later."""
        now_s = self._clock()
        if now_s - self._shown_s < self._period_s:
            return False
        self._shown_s = now_s
        return True

    def write(self, text: str, share: float) -> None:
        """Show a text and a share, from 0 to 1."""
        if not self._is_bar:
            print(text, file=self._stream, flush=True)
            return
        full = round(share * _BAR_CELLS)
        line = f"[{'#' * full}{'.' * (_BAR_CELLS - full)}] {text}"
        self._stream.write(f"\r{line:{self._width}}")
        self._stream.flush()
        self._width = len(line)

    def tell(self, line: str) -> None:
        """Print a line of its own."""
        self._wipe()
        print(line, file=self._stream, flush=True)

    def __enter__(self) -> Self:
        """Return itself."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        """Wipe the bar."""
        self._wipe()

    def _wipe(self) -> None:
        if self._width:
            self._stream.write(f"\r{'':{self._width}}\r")
            self._stream.flush()


class Progress(Bar):
    """Shows how far a run is: round, simulated time and real-time factor."""

    def __init__(
        self,
        rounds: int | None,
        until_s: float | None,
        stream: TextIO | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Show progress towards an end.

        Args:
            rounds: the run ends after the meeting of this round, or ``None``.
            until_s: the run ends at this simulated time, or ``None``.
            stream: where to; by default standard error.
            clock: wall time in seconds.
        """
        super().__init__(stream, clock)
        self._rounds = rounds
        self._until_s = until_s

    @classmethod
    def towards(cls, rounds: int | None, limit_s: float, method: Method) -> Self:
        """Show progress towards the meeting of a round or, where none is counted, a time.

        Args:
            rounds: as asked for, or ``None``.
            limit_s: when the run ends at the latest (simulated time).
            method: of coordination.
        """
        if rounds is None or not method.meets_in_windows:
            return cls(None, limit_s)
        return cls(rounds, None)

    def show(self, sim_s: float, meetings_ended: int) -> None:
        """Show how far the run is, if it is time to."""
        if not self.is_due():
            return
        factor = sim_s / self.elapsed_s
        round_text = f"round {max(0, meetings_ended - 1)}"
        if self._rounds is not None:
            round_text += f"/{self._rounds}"
        text = f"{round_text}  {sim_s:8.1f} s simulated  {factor:6.1f} × real time"
        self.write(text, self._share(sim_s, meetings_ended))

    def _share(self, sim_s: float, meetings_ended: int) -> float:
        if self._until_s is not None:
            return min(1.0, sim_s / self._until_s)
        return min(1.0, meetings_ended / (self._rounds + 1)) if self._rounds is not None else 0.0
