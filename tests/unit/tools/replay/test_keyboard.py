"""Tests of ``tlcomm_tools.replay.keyboard`` with a terminal of their own."""

import io
import os
import sys
import termios
from collections.abc import Iterator

import pytest

from tlcomm_tools.replay.keyboard import Key, Keyboard, open_keyboard, parse_keys


@pytest.fixture
def terminal(monkeypatch: pytest.MonkeyPatch) -> Iterator[tuple[int, int]]:
    """Make standard input a terminal; yield the end that types, and it."""
    typist, fd = os.openpty()
    with os.fdopen(fd, "rb", closefd=False) as stream:
        monkeypatch.setattr(sys, "stdin", stream)
        yield typist, fd
    for end in (typist, fd):
        try:
            os.close(end)
        except OSError:
            continue


@pytest.mark.parametrize(
    ("typed", "keys"),
    [
        (b" .q", [Key.PAUSE, Key.STEP, Key.QUIT]),
        (b"\x1b[C\x1bOC", [Key.STEP, Key.STEP]),
        (b"\x1b[A\x1b[1;5qx\n", []),
    ],
)
def test_keys(typed: bytes, keys: list[Key]) -> None:
    """Space, full stop, right arrow (of either kind) and q; not the q that ends a sequence."""
    assert parse_keys(typed) == keys


def test_a_key_needs_no_return(terminal: tuple[int, int]) -> None:
    """A key arrives as it is typed, and the terminal is afterwards as before."""
    typist, fd = terminal
    before = termios.tcgetattr(fd)
    with open_keyboard() as keyboard:
        assert keyboard.is_there
        assert keyboard.wait(0.0) == []
        os.write(typist, b" ")
        assert keyboard.wait(10.0) == [Key.PAUSE]
    assert termios.tcgetattr(fd) == before


def test_a_terminal_that_goes_quits() -> None:
    """At the end of input nobody can go on, and nothing is read any more."""
    reader, writer = os.pipe()
    os.close(writer)
    keyboard = Keyboard(reader)
    assert keyboard.wait(None) == [Key.QUIT]
    assert not keyboard.is_there
    os.close(reader)


def test_without_a_terminal_nobody_types(monkeypatch: pytest.MonkeyPatch) -> None:
    """A pipe or a file is left unread."""
    monkeypatch.setattr(sys, "stdin", io.StringIO("q"))
    with open_keyboard() as keyboard:
        assert not keyboard.is_there
        assert keyboard.wait(0.0) == []
