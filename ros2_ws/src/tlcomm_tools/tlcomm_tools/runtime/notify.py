"""How a process of a run tells its supervisor what it is at: JSON lines over an inherited pipe.

``Notifier``     the process's end
``Note``         any of ``Started``, ``Ready``, ``Progress``, ``Finished``, ``Failed``
``decode_note``  one line, as the supervisor reads it
``watch_parent``  ends this process when its supervisor is gone
"""

import json
import math
import os
import signal
import sys
import threading
from dataclasses import asdict, dataclass
from typing import Self

__all__ = [
    "NOTIFY_FD_VARIABLE",
    "Failed",
    "Finished",
    "Note",
    "Notifier",
    "Progress",
    "Ready",
    "Started",
    "decode_note",
    "watch_parent",
]

NOTIFY_FD_VARIABLE = "TLCOMM_NOTIFY_FD"
_PARENT_GRACE_S = 5.0


@dataclass(frozen=True, slots=True)
class Started:
    """The process has read its input and planned; it is looking for the others."""


@dataclass(frozen=True, slots=True)
class Ready:
    """The process has found all the others."""


@dataclass(frozen=True, slots=True)
class Progress:
    """The run has got so far.

    Attributes:
        sim_s: simulated time.
        meetings_ended: by the slowest agent; the meeting at t = 0 counts.
    """

    sim_s: float
    meetings_ended: int


@dataclass(frozen=True, slots=True)
class Finished:
    """The process has done all it had to and is leaving."""


@dataclass(frozen=True, slots=True)
class Failed:
    """The process gives up.

    Attributes:
        reason: one line.
        status: the exit status that the whole command should have.
    """

    reason: str
    status: int


Note = Started | Ready | Progress | Finished | Failed

_KINDS: dict[str, type[Started | Ready | Finished]] = {
    "started": Started,
    "ready": Ready,
    "finished": Finished,
}
_NAMES: dict[type[Note], str] = {
    Started: "started",
    Ready: "ready",
    Progress: "progress",
    Finished: "finished",
    Failed: "failed",
}


class Notifier:
    """The process's end of the pipe; without a supervisor it says nothing to nobody."""

    def __init__(self, fd: int | None) -> None:
        """Write to ``fd``, if there is one."""
        self._fd = fd

    @classmethod
    def from_environment(cls) -> Self:
        """Find the pipe's number where the supervisor left it, and keep it from child processes."""
        text = os.environ.pop(NOTIFY_FD_VARIABLE, "")
        if not text.isdecimal():
            return cls(None)
        os.set_inheritable(int(text), False)  # noqa: FBT003 (its signature)
        return cls(int(text))

    def tell(self, note: Note) -> None:
        """Send one note; a supervisor that has gone is noticed by ``watch_parent``, not here."""
        if self._fd is None:
            return
        line = json.dumps({"event": _NAMES[type(note)], **asdict(note)}) + "\n"
        try:
            os.write(self._fd, line.encode())
        except BrokenPipeError:
            self._fd = None


def decode_note(line: bytes) -> Note | None:
    """Return the note in one line, or None for anything else: a process can't harm its supervisor.

    Args:
        line: one line, with or without its end.
    """
    try:
        fields = json.loads(line)
    except ValueError:
        return None
    match fields:
        case {"event": "progress", "sim_s": int() | float() as sim_s, "meetings_ended": int() as n}:
            return Progress(float(sim_s), n) if math.isfinite(sim_s) else None
        case {"event": "failed", "reason": str() as reason, "status": int() as status}:
            return Failed(reason, status)
        case {"event": str() as event} if event in _KINDS:
            return _KINDS[event]()
        case _:
            return None


def watch_parent() -> None:
    """End this process when its supervisor ends, however that dies.

    The supervisor holds the other end of standard input and never writes to it: the end of file is
    the end of the supervisor. Then this process ends as on SIGTERM, or the hard way 5 s later.
    """
    threading.Thread(target=_await_parent, name="watch_parent", daemon=True).start()


def _await_parent() -> None:
    fd = sys.stdin.fileno()
    while os.read(fd, 4096):
        pass
    os.kill(os.getpid(), signal.SIGTERM)
    threading.Event().wait(_PARENT_GRACE_S)
    os._exit(1)
