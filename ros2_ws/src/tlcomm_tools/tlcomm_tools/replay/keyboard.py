"""The keyboard of a replay: pause, step and quit.

``Key``             what a key asks for
``parse_keys``      what a terminal's bytes ask for
``Keyboard``        waits for keys
``open_keyboard``   standard input without echo and line by line, if it is a terminal
"""

import os
import re
import select
import sys
import termios
import time
import tty
from collections.abc import Iterator
from contextlib import contextmanager
from enum import Enum, auto
from typing import Final

__all__ = ["Key", "Keyboard", "open_keyboard", "parse_keys"]

_MOST_BYTES: Final = 1024


class Key(Enum):
    """What a key asks for."""

    PAUSE = auto()
    STEP = auto()
    QUIT = auto()


_KEYS: Final = {
    b" ": Key.PAUSE,
    b".": Key.STEP,
    b"\x1b[C": Key.STEP,
    b"\x1bOC": Key.STEP,
    b"q": Key.QUIT,
}
# An escape sequence is one key, so that the letter at its end isn't taken for another.
_STROKE: Final = re.compile(rb"\x1b[\[O][0-9;]*[A-Za-z~]|.", re.DOTALL)


def parse_keys(typed: bytes) -> list[Key]:
    """Return what the keys ask for; others ask for nothing."""
    strokes: list[bytes] = _STROKE.findall(typed)
    return [_KEYS[stroke] for stroke in strokes if stroke in _KEYS]


class Keyboard:
    """Waits for keys, or for the time to pass where there is no terminal."""

    def __init__(self, fd: int | None) -> None:
        """Take a terminal's descriptor, or ``None``."""
        self._fd = fd

    @property
    def is_there(self) -> bool:
        """Whether anybody can type."""
        return self._fd is not None

    def wait(self, timeout_s: float | None) -> list[Key]:
        """Return what was asked for; nothing after the time has passed.

        Args:
            timeout_s: how long to wait, or ``None`` for as long as there is a terminal.
        """
        if self._fd is None:
            time.sleep(timeout_s or 0.0)
            return []
        if not select.select([self._fd], [], [], timeout_s)[0]:
            return []
        typed = os.read(self._fd, _MOST_BYTES)
        if not typed:
            # The terminal is gone: whoever paused can't go on.
            self._fd = None
            return [Key.QUIT]
        return parse_keys(typed)


@contextmanager
def open_keyboard() -> Iterator[Keyboard]:
    """Yield the keyboard, and leave the terminal as it was."""
    fd = _find_terminal()
    if fd is None:
        yield Keyboard(None)
        return
    before = termios.tcgetattr(fd)
    tty.setcbreak(fd)
    try:
        yield Keyboard(fd)
    finally:
        termios.tcsetattr(fd, termios.TCSADRAIN, before)


def _find_terminal() -> int | None:
    """Return standard input if it is a terminal that this process may read."""
    try:
        fd = sys.stdin.fileno()
    except (AttributeError, OSError, ValueError):
        return None
    if not os.isatty(fd):
        return None
    try:
        is_in_front = os.tcgetpgrp(fd) == os.getpgrp()
    except OSError:
        # Not the terminal that controls this process, so that nothing keeps it from reading.
        return fd
    return fd if is_in_front else None
