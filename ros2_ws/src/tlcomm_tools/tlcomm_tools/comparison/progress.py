"""How far a comparison is, on standard error.

``JobProgress``  jobs done and the time that the others may take
"""

import time
from collections.abc import Callable, Sequence
from typing import TextIO

from tlcomm_tools.comparison.job import Job
from tlcomm_tools.progress import Bar

__all__ = ["JobProgress"]

_MINUTE_S = 60


class JobProgress(Bar):
    """Shows how many jobs are done, and how long the others may take."""

    def __init__(
        self,
        missing: Sequence[Job],
        done: int,
        stream: TextIO | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        """Show progress towards all jobs.

        Args:
            missing: those to do.
            done: how many an earlier command did.
            stream: where to; by default standard error.
            clock: wall time in seconds.
        """
        super().__init__(stream, clock)
        self._jobs = done + len(missing)
        self._done = done
        self._effort = sum(job.effort for job in missing)
        self._spent = 0.0

    def count(self, job: Job) -> None:
        """Count one more that is done."""
        self._done += 1
        self._spent += job.effort

    def show(self) -> None:
        """Show how far it is, if it is time to."""
        if self.is_due():
            self.write(self._text(), self._done / self._jobs)

    def _text(self) -> str:
        text = f"{self._done}/{self._jobs} runs  {_clock_text(self.elapsed_s)}"
        if self._spent:
            left_s = self.elapsed_s * (self._effort - self._spent) / self._spent
            text += f", about {_clock_text(left_s)} left"
        return text


def _clock_text(time_s: float) -> str:
    minutes, seconds = divmod(round(time_s), _MINUTE_S)
    return f"{minutes}:{seconds:02} min"
