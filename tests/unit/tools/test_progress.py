"""Tests of ``tlcomm_tools.progress``."""

import math
from io import StringIO

import pytest

from tlcomm_core.method import Method
from tlcomm_tools.progress import Progress


class Terminal(StringIO):
    """A stream that says that it is a terminal."""

    def isatty(self) -> bool:
        """Say so."""
        return True


class FakeClock:
    """A clock that a test sets."""

    now_s = 0.0

    def __call__(self) -> float:
        """Return the time."""
        return self.now_s


def test_lines_come_now_and_then() -> None:
    """Without a terminal there is a line every five seconds, with round, time and factor."""
    stream, clock = StringIO(), FakeClock()
    with Progress(10, None, stream, clock) as progress:
        for clock.now_s in (1.0, 4.9, 5.0, 6.0, 10.0):
            progress.show(20.0 * clock.now_s, 3)
    assert stream.getvalue() == (
        "round 2/10     100.0 s simulated    20.0 × real time\n"
        "round 2/10     200.0 s simulated    20.0 × real time\n"
    )


def test_a_terminal_has_a_bar_that_goes_away() -> None:
    """On a terminal a bar is drawn over itself and wiped at the end."""
    stream, clock = Terminal(), FakeClock()
    with Progress(None, 100.0, stream, clock) as progress:
        for clock.now_s in (0.05, 0.2, 0.4):
            progress.show(250.0 * clock.now_s, 1)
    first, second, blank, rest = stream.getvalue().split("\r")[1:]
    assert first.startswith("[############............] round 0")
    assert second.startswith("[########################] round 0")
    assert len(second) <= 80
    assert (blank.strip(), rest) == ("", "")


def test_what_is_told_stays_above_the_bar() -> None:
    """A line that is told takes the place of the bar, which is drawn again below it."""
    stream, clock = Terminal(), FakeClock()
    with Progress(None, 100.0, stream, clock) as progress:
        clock.now_s = 0.2
        progress.show(50.0, 1)
        progress.tell("ROS domain 3")
        clock.now_s = 0.4
        progress.show(60.0, 1)
    _, _, told, again, *_ = stream.getvalue().split("\r")
    assert told.strip() == ""
    assert again.startswith("ROS domain 3\n")


def test_nothing_shown_leaves_nothing() -> None:
    """A run shorter than a period writes nothing at all."""
    stream = Terminal()
    with Progress(5, None, stream, FakeClock()) as progress:
        progress.show(1.0, 0)
    assert stream.getvalue() == ""


@pytest.mark.parametrize(
    ("method", "rounds", "text"),
    [
        (Method.TEAM, 10, "round 2/10"),
        (Method.ALL_TIME, 10, "round 2 "),
        (Method.TEAM, None, "round 2 "),
    ],
)
def test_only_windows_are_counted(
    method: Method, rounds: int | None, text: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """Turns and pairs' meetings are as many as there happen to be: there time is the measure."""
    progress = Progress.towards(rounds, 60.0, method)
    progress._shown_s = -math.inf
    progress.show(30.0, 3)
    assert capsys.readouterr().err.startswith(text)
