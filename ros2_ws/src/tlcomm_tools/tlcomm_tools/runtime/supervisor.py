"""Starting, watching and ending the processes of a run, without ROS.

``run_processes``  from start to end
``RunOutcome``     ``RunFinished``, ``RunFailed`` or ``RunInterrupted``
``Deadlines``      how long anything may take

Everything is an event: notes and exits arrive through file descriptors, so nothing is polled and
nobody sleeps. Whatever happens, no process is left when ``run_processes`` returns; and if the
supervisor itself is killed, its processes notice (``notify.watch_parent``).
"""

import contextlib
import selectors
import signal
import socket
import threading
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from tlcomm_tools.runtime.child import Child, ProcessSpec
from tlcomm_tools.runtime.notify import Note, Progress
from tlcomm_tools.status import Status

__all__ = [
    "DEADLINES",
    "Deadlines",
    "ProcessSpec",
    "RunFailed",
    "RunFinished",
    "RunInterrupted",
    "RunOutcome",
    "run_processes",
]

_INTERRUPTING = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


@dataclass(frozen=True, slots=True)
class Deadlines:
    """Limits in seconds of wall time.

    Attributes:
        start_s: until all processes are ready.
        progress_s: between two steps of progress, once all are ready.
        finish_s: from the first process that has finished until the last one's exit.
        interrupt_s: from SIGINT to SIGTERM.
        terminate_s: from SIGTERM to SIGKILL.
    """

    start_s: float = 60.0
    progress_s: float = 30.0
    finish_s: float = 15.0
    interrupt_s: float = 2.0
    terminate_s: float = 2.0


DEADLINES = Deadlines()


@dataclass(frozen=True, slots=True)
class RunFinished:
    """All processes have done what they had to."""


@dataclass(frozen=True, slots=True)
class RunInterrupted:
    """The user has had enough: SIGINT, SIGTERM or SIGHUP."""


@dataclass(frozen=True, slots=True)
class RunFailed:
    """A process broke the run.

    Attributes:
        name: which.
        reason: one line.
        status: the exit status that the whole command should have: 3, or 2 for bad input.
        log_tail: the last lines of the process's log.
    """

    name: str
    reason: str
    status: int = Status.BROKEN
    log_tail: tuple[str, ...] = ()


RunOutcome = RunFinished | RunFailed | RunInterrupted


def run_processes(
    specs: Sequence[ProcessSpec],
    environment: Mapping[str, str],
    on_note: Callable[[str, Note], None],
    deadlines: Deadlines = DEADLINES,
) -> RunOutcome:
    """Run processes until all have finished, one has failed, or the user interrupts.

    In the main thread SIGINT, SIGTERM and SIGHUP end the run in good order; in another thread
    signals are left alone.

    Args:
        specs: what to start, all at once.
        environment: of all of them.
        on_note: called with a process's name and each of its notes.
        deadlines: limits.

    Returns:
        How it ended; none of the processes, nor any that they started, is left.
    """
    with _interruption() as interruption, contextlib.closing(_Run(interruption, deadlines)) as run:
        outcome: RunOutcome | None = run.start(specs, environment)
        while outcome is None:
            run.wait(on_note)
            outcome = run.judge()
        run.stop()
        return run.with_log(outcome)


class _Run:
    """The children of one run and what is known about its progress."""

    def __init__(self, interruption: socket.socket | None, deadlines: Deadlines) -> None:
        self._deadlines = deadlines
        self._children: list[Child] = []
        self._selector = selectors.DefaultSelector()
        self._interrupted = False
        self._started_s = time.monotonic()
        self._moved_s: float | None = None
        self._finishing_s: float | None = None
        self._leader = "run"
        self._interruption = interruption
        if interruption is not None:
            self._selector.register(interruption, selectors.EVENT_READ, None)

    def start(
        self, specs: Sequence[ProcessSpec], environment: Mapping[str, str]
    ) -> RunFailed | None:
        """Start all processes; say which one can't be started."""
        for spec in specs:
            try:
                child = Child(spec, environment)
            except OSError as error:
                return RunFailed(spec.name, f"can't be started: {error}")
            self._children.append(child)
            self._selector.register(child.notes_fd, selectors.EVENT_READ, child)
            self._selector.register(child.exit_fd, selectors.EVENT_READ, child)
        return None

    def wait(self, on_note: Callable[[str, Note], None]) -> None:
        """Wait for an event or the next deadline, and take in what has happened."""
        timeout_s = max(0.0, self._due()[0] - time.monotonic())
        for child in self._select(timeout_s):
            for note in child.read_notes():
                if isinstance(note, Progress):
                    self._moved_s = time.monotonic()
                    self._leader = child.spec.name
                on_note(child.spec.name, note)
        now_s = time.monotonic()
        if self._moved_s is None and all(child.ready for child in self._children):
            self._moved_s = now_s
        if self._finishing_s is None and any(child.finished for child in self._children):
            self._finishing_s = now_s

    def judge(self) -> RunOutcome | None:
        """Return how the run has ended, or None if it goes on."""
        if self._interrupted:
            return RunInterrupted()
        for child in self._children:
            if child.failed is not None:
                return RunFailed(child.spec.name, child.failed.reason, child.failed.status)
            if child.status is not None and not (child.finished and child.status == 0):
                return RunFailed(child.spec.name, child.describe_exit())
        if all(child.status == 0 for child in self._children):
            return RunFinished()
        due_s, failure = self._due()
        return failure if time.monotonic() >= due_s else None

    def stop(self) -> None:
        """End what still lives, in good order: first those that act, last the one that records."""
        for last in (False, True):
            group = [child for child in self._children if child.spec.stop_last is last]
            for number, patience_s in (
                (signal.SIGINT, self._deadlines.interrupt_s),
                (signal.SIGTERM, self._deadlines.terminate_s),
                (signal.SIGKILL, None),
            ):
                self._end(group, number, patience_s)

    def with_log(self, outcome: RunOutcome) -> RunOutcome:
        """Add the log's tail to a failure."""
        if not isinstance(outcome, RunFailed):
            return outcome
        tails = [c.log_tail() for c in self._children if c.spec.name == outcome.name]
        return RunFailed(outcome.name, outcome.reason, outcome.status, *tails[:1])

    def close(self) -> None:
        """Leave nothing behind, also when something unforeseen has happened."""
        self._end(self._children, signal.SIGKILL, None)
        self._selector.close()
        for child in self._children:
            child.close()

    def _due(self) -> tuple[float, RunFailed]:
        """Return the next deadline (monotonic, s) and what it means to miss it."""
        limits, children = self._deadlines, self._children
        if self._finishing_s is not None:
            late = _first(children, lambda child: child.status is not None)
            reason = f"not ended {limits.finish_s:g} s after the run was over"
            return self._finishing_s + limits.finish_s, RunFailed(late, reason)
        if self._moved_s is not None:
            reason = f"no progress for {limits.progress_s:g} s"
            return self._moved_s + limits.progress_s, RunFailed(self._leader, reason)
        if all(child.started for child in children):
            late = _first(children, lambda child: child.ready)
            reason = f"the others not found within {limits.start_s:g} s"
        else:
            late = _first(children, lambda child: child.started)
            reason = f"not started within {limits.start_s:g} s"
        return self._started_s + limits.start_s, RunFailed(late, reason)

    def _end(
        self, group: Sequence[Child], number: signal.Signals, patience_s: float | None
    ) -> None:
        alive = [child for child in group if child.status is None]
        for child in alive:
            child.signal(number)
        until_s = None if patience_s is None else time.monotonic() + patience_s
        while any(child.status is None for child in alive):
            timeout_s = None if until_s is None else until_s - time.monotonic()
            if timeout_s is not None and timeout_s <= 0.0:
                return
            for child in self._select(timeout_s):
                child.read_notes()

    def _select(self, timeout_s: float | None) -> list[Child]:
        """Return the children with news, ended ones reaped."""
        news: dict[Child, None] = {}
        for key, _ in self._selector.select(timeout_s):
            child = key.data
            if child is None:
                self._take_interruption()
                continue
            news[child] = None
            if key.fileobj == child.exit_fd:
                child.reap()
            if child.status is not None or child.silent:
                self._selector.unregister(key.fileobj)
        return list(news)

    def _take_interruption(self) -> None:
        assert self._interruption is not None
        numbers = self._interruption.recv(64)
        self._interrupted |= any(number in _INTERRUPTING for number in numbers)


def _first(children: Sequence[Child], fine: Callable[[Child], bool]) -> str:
    return next((child.spec.name for child in children if not fine(child)), "run")


@contextlib.contextmanager
def _interruption() -> Iterator[socket.socket | None]:
    """Turn signals into something readable for as long as the context lasts."""
    if threading.current_thread() is not threading.main_thread():
        yield None
        return
    receiver, sender = socket.socketpair()
    with receiver, sender:
        sender.setblocking(False)  # noqa: FBT003 (its signature)
        old_fd = signal.set_wakeup_fd(sender.fileno(), warn_on_full_buffer=False)
        old = {number: signal.signal(number, lambda *_: None) for number in _INTERRUPTING}
        try:
            yield receiver
        finally:
            for number, handler in old.items():
                signal.signal(number, handler)
            signal.set_wakeup_fd(old_fd)
