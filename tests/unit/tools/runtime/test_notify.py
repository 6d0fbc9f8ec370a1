"""Notes from a process to its supervisor."""

import os

import pytest

from tlcomm_tools.runtime.notify import (
    NOTIFY_FD_VARIABLE,
    Failed,
    Finished,
    Note,
    Notifier,
    Progress,
    Ready,
    Started,
    decode_note,
)

NOTES = [Started(), Ready(), Progress(1.25, 3), Finished(), Failed("no answer\nfrom 'a'", 3)]


@pytest.mark.parametrize("note", NOTES, ids=lambda note: type(note).__name__)
def test_note_survives_the_pipe(note: Note) -> None:
    """Each kind of note is read as it was told, one line each."""
    read_fd, write_fd = os.pipe()
    with os.fdopen(read_fd, "rb") as reader, os.fdopen(write_fd, "wb"):
        Notifier(write_fd).tell(note)
        assert decode_note(reader.readline()) == note


@pytest.mark.parametrize(
    "line",
    [
        b"",
        b"\xff",
        b"ready",
        b"[]",
        b'{"event": "dance"}',
        b'{"event": ["ready"]}',
        b'{"event": "progress"}',
        b'{"event": "progress", "sim_s": "1", "meetings_ended": 1}',
        b'{"event": "progress", "sim_s": NaN, "meetings_ended": 1}',
        b'{"event": "failed", "reason": 1, "status": 3}',
    ],
)
def test_anything_else_is_no_note(line: bytes) -> None:
    """A malformed line is nothing, not an error."""
    assert decode_note(line) is None


def test_without_a_supervisor_nothing_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    """A process started by hand has nobody to tell."""
    monkeypatch.delenv(NOTIFY_FD_VARIABLE, raising=False)
    Notifier.from_environment().tell(Ready())


def test_own_children_do_not_inherit_the_pipe(monkeypatch: pytest.MonkeyPatch) -> None:
    """The pipe's number is taken out of the environment, and the pipe closed to children."""
    read_fd, write_fd = os.pipe()
    os.set_inheritable(write_fd, True)
    with os.fdopen(read_fd, "rb") as reader, os.fdopen(write_fd, "wb"):
        monkeypatch.setenv(NOTIFY_FD_VARIABLE, str(write_fd))
        Notifier.from_environment().tell(Ready())
        assert NOTIFY_FD_VARIABLE not in os.environ
        assert not os.get_inheritable(write_fd)
        assert decode_note(reader.readline()) == Ready()


def test_supervisor_gone(monkeypatch: pytest.MonkeyPatch) -> None:
    """Telling a supervisor that has gone changes nothing."""
    read_fd, write_fd = os.pipe()
    os.close(read_fd)
    with os.fdopen(write_fd, "wb"):
        monkeypatch.setenv(NOTIFY_FD_VARIABLE, str(write_fd))
        notifier = Notifier.from_environment()
        notifier.tell(Ready())
        notifier.tell(Ready())
