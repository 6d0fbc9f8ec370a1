"""One supervised process.

``ProcessSpec``  what to start
``Child``        the process once started, with its pipes
"""

import os
import signal
import subprocess
from collections import deque
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from tlcomm_tools.runtime.notify import (
    NOTIFY_FD_VARIABLE,
    Failed,
    Finished,
    Note,
    Ready,
    Started,
    decode_note,
)

__all__ = ["Child", "ProcessSpec"]

_TAIL_LINES = 15
_TAIL_BYTES = 64 * 1024
_READ_BYTES = 64 * 1024


@dataclass(frozen=True, slots=True)
class ProcessSpec:
    """A process of a run.

    Attributes:
        name: what it is called in reports.
        command: program and arguments.
        log: file for its standard output and error.
        stop_last: whether it is stopped only after all others have gone (the recorder).
    """

    name: str
    command: tuple[str, ...]
    log: Path
    stop_last: bool = False


class Child:
    """A running process in a session of its own, and what it has told so far.

    Attributes:
        spec: what was started.
        started: it has read its input.
        ready: it has found the others.
        finished: it has said that it is done.
        failed: why it gave up, if it said so.
        silent: it has closed its end of the pipe.
        status: its exit status as ``subprocess`` gives it, None while it lives.
    """

    def __init__(self, spec: ProcessSpec, environment: Mapping[str, str]) -> None:
        """Start the process.

        Raises:
            OSError: the program or the log file can't be opened.
        """
        self.spec = spec
        self.started = self.ready = self.finished = self.silent = False
        self.failed: Failed | None = None
        self.status: int | None = None
        self._rest = b""
        self.notes_fd, write_fd = os.pipe()
        try:
            with spec.log.open("wb") as log:
                self._process = subprocess.Popen(
                    spec.command,
                    # Its end of file tells the child that the supervisor is gone.
                    stdin=subprocess.PIPE,
                    stdout=log,
                    stderr=subprocess.STDOUT,
                    env={**environment, NOTIFY_FD_VARIABLE: str(write_fd)},
                    pass_fds=(write_fd,),
                    start_new_session=True,
                )
        except OSError:
            os.close(self.notes_fd)
            raise
        finally:
            os.close(write_fd)
        os.set_blocking(self.notes_fd, False)
        self.exit_fd = os.pidfd_open(self._process.pid)

    def read_notes(self) -> tuple[Note, ...]:
        """Take what the process has said since the last call; what isn't a note is left out."""
        while chunk := self._read():
            self._rest += chunk
        *lines, self._rest = self._rest.split(b"\n")
        notes = tuple(note for note in map(decode_note, lines) if note is not None)
        for note in notes:
            self._take(note)
        return notes

    def signal(self, number: signal.Signals) -> None:
        """Send a signal to the process and whatever it has started, if it still lives."""
        if self.status is None:
            os.killpg(self._process.pid, number)

    def reap(self) -> None:
        """Take the exit status of a process that has ended; what it left running is killed.

        The group is killed before the status is taken: until then nobody else can have its number.
        """
        self.signal(signal.SIGKILL)
        self.status = self._process.wait()

    def close(self) -> None:
        """Close the pipes of a process that has been reaped."""
        assert self.status is not None
        assert self._process.stdin is not None
        self._process.stdin.close()
        os.close(self.notes_fd)
        os.close(self.exit_fd)

    def describe_exit(self) -> str:
        """Say how the process ended."""
        assert self.status is not None
        if self.status < 0:
            return f"killed by {signal.Signals(-self.status).name}"
        if self.status > 0:
            return f"ended with exit status {self.status}"
        return "ended before the run was over"

    def log_tail(self) -> tuple[str, ...]:
        """Return the last lines of its log."""
        try:
            with self.spec.log.open("rb") as log:
                log.seek(max(0, os.fstat(log.fileno()).st_size - _TAIL_BYTES))
                lines = deque(log, maxlen=_TAIL_LINES)
        except OSError:
            return ()
        return tuple(line.decode(errors="replace").rstrip() for line in lines)

    def _read(self) -> bytes:
        try:
            chunk = os.read(self.notes_fd, _READ_BYTES)
        except BlockingIOError:
            return b""
        self.silent = not chunk
        return chunk

    def _take(self, note: Note) -> None:
        match note:
            case Started():
                self.started = True
            case Ready():
                self.started = self.ready = True
            case Finished():
                self.finished = True
            case Failed():
                self.failed = self.failed or note
            case _:
                pass
