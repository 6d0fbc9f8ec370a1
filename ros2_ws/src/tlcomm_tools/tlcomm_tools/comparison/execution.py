"""Doing a comparison's jobs and keeping what they leave.

``run_missing``  those that aren't done yet
"""

import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor

from tlcomm_tools.comparison.archive import Archive
from tlcomm_tools.comparison.job import Failed, Job
from tlcomm_tools.comparison.processes import process_outcomes
from tlcomm_tools.comparison.progress import JobProgress
from tlcomm_tools.comparison.workers import outcomes

__all__ = ["run_missing"]


def run_missing(
    jobs: Sequence[Job], archive: Archive, workers: Executor | None, act: Callable[[], None]
) -> dict[Job, str]:
    """Run what isn't done yet, those that take longest first, so that nobody waits for the last.

    Args:
        jobs: all of them.
        archive: where they are kept.
        workers: who does them; ``None`` for ROS processes, a team at a time.
        act: called now and then; acts upon an interruption.

    Returns:
        Of each job that failed, why.

    Raises:
        KeyboardInterrupt: interrupted; what is done has been kept.
    """
    failed: dict[Job, str] = {}
    missing = sorted((job for job in jobs if not archive.has(job)), key=lambda job: -job.effort)
    done = len(jobs) - len(missing)
    try:
        with JobProgress(missing, done) as progress:

            def on_wait() -> None:
                act()
                progress.show()

            for job, error in _done(missing, archive, workers, on_wait):
                progress.count(job)
                if error is None:
                    done += 1
                else:
                    failed[job] = error.reason
    except KeyboardInterrupt:
        print(
            f"tlcomm: {done} of {len(jobs)} runs are done; the same command with"
            f" --out {archive.path} goes on",
            file=sys.stderr,
        )
        raise
    return failed


def _done(
    jobs: Sequence[Job],
    archive: Archive,
    workers: Executor | None,
    on_wait: Callable[[], None],
) -> Iterator[tuple[Job, Failed | None]]:
    """Yield jobs once their files are in place, or with why there are none."""
    if workers is None:
        yield from process_outcomes(archive, jobs, on_wait)
        return
    for job, outcome in outcomes(workers, jobs, on_wait):
        if isinstance(outcome, Failed):
            yield job, outcome
        else:
            archive.keep(job, outcome.files)
            yield job, None
