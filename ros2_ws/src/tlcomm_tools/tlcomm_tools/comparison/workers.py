"""Who does a comparison's jobs: processes of this machine; and how any workers do them.

``local_workers``  one process per core
``outcomes``       jobs done, as they come
"""

import multiprocessing
import os
import signal
import threading
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager
from typing import Final

from tlcomm_tools.comparison.in_process import execute
from tlcomm_tools.comparison.job import Failed, Job, Outcome

__all__ = ["local_workers", "outcomes"]

_LOOK_S: Final = 0.2
# Each worker has a core to itself, so what numpy calls must not start threads.
_SINGLE_THREAD: Final = dict.fromkeys(
    ("MKL_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"), "1"
)


@contextmanager
def local_workers(count: int | None = None) -> Iterator[Executor]:
    """Give workers of this machine; they end with the block, at once if it is left by an error.

    Args:
        count: how many; by default as many as this process may use cores.
    """
    cores = len(os.sched_getaffinity(0))
    context = multiprocessing.get_context("spawn")
    pool = ProcessPoolExecutor(
        cores if count is None else count, mp_context=context, initializer=_end_with_parent
    )
    try:
        yield pool
    except BaseException:
        pool.shutdown(wait=False, cancel_futures=True)
        for process in multiprocessing.active_children():
            process.terminate()
        raise
    finally:
        pool.shutdown()


def _end_with_parent() -> None:
    """Let this process end when the one that started it does, however that ends."""

    def watch() -> None:
        parent = multiprocessing.parent_process()
        assert parent is not None, "a worker is a child"
        parent.join()
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def outcomes(
    workers: Executor, jobs: Sequence[Job], on_wait: Callable[[], None]
) -> Iterator[tuple[Job, Outcome]]:
    """Yield jobs with what became of them, as they are done.

    Args:
        workers: who does them.
        jobs: in the order in which they are begun.
        on_wait: called now and then in between.

    Raises:
        KeyboardInterrupt: if ``on_wait`` does.
    """
    with _sheltered():
        pending = {workers.submit(execute, job): job for job in jobs}
    while pending:
        done, _ = wait(pending, _LOOK_S, FIRST_COMPLETED)
        on_wait()
        for future in done:
            yield pending.pop(future), _outcome(future)


def _outcome(future: "Future[Outcome]") -> Outcome:
    if future.cancelled():
        return Failed("the cluster gave it up; the same command goes on with what is missing")
    error = future.exception()
    match error:
        case None:
            return future.result()
        case BrokenProcessPool():
            return Failed("a worker process died; the same command goes on with what is missing")
        case _:
            return Failed(f"{type(error).__name__}: {' '.join(str(error).split())}")


@contextmanager
def _sheltered() -> Iterator[None]:
    """Let processes that start meanwhile have one numeric thread and leave Ctrl-C to this one.

    They inherit both.
    """
    before = {name: os.environ.get(name) for name in _SINGLE_THREAD}
    os.environ.update(_SINGLE_THREAD)
    mask = signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, mask)
        for name, value in before.items():
            if value is None:
                del os.environ[name]
            else:
                os.environ[name] = value
