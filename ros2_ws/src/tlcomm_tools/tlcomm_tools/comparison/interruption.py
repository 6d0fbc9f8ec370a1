"""Ctrl-C where it can be dealt with, and nowhere else.

``held_interruption``  lets it be asked for
"""

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Final

__all__ = ["held_interruption"]

_INTERRUPTING: Final = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


@contextmanager
def held_interruption() -> Iterator[Callable[[], None]]:
    """Let a signal to end be acted upon only where the function given is called.

    It raises ``KeyboardInterrupt`` once such a signal has come. Anywhere else, in the midst of
    starting processes or of ending them, it would leave some behind; and so would a second one.
    For the main thread only.
    """
    caught: list[int] = []

    def act() -> None:
        if caught:
            raise KeyboardInterrupt

    before = {
        number: signal.signal(number, lambda own, _: caught.append(own)) for number in _INTERRUPTING
    }
    try:
        yield act
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
