"""A live view's process, as the run sees it."""

import os
import sys
import threading
from pathlib import Path

import pytest

from tlcomm_tools.runtime import onlooker
from tlcomm_tools.runtime.onlooker import Onlooker

LIMIT_S = 60.0
# Says an address, then what it was told, into a file; ends with its input.
GOOD = """
import sys
print("http://there/", flush=True)
with open(sys.argv[1], "w") as heard:
    for line in sys.stdin:
        heard.write(line)
        heard.flush()
"""
# Goes on, whatever becomes of its input.
DEAF = "import threading\nprint('http://there/', flush=True)\nthreading.Event().wait()"


class Told:
    """What a user was told, and when."""

    def __init__(self) -> None:
        """Begin with nothing."""
        self.lines: list[str] = []
        self._came = threading.Semaphore(0)

    def take(self, line: str) -> None:
        """Take a line."""
        self.lines.append(line)
        self._came.release()

    def await_line(self) -> str:
        """Return the next line, once it has come."""
        assert self._came.acquire(timeout=LIMIT_S)
        return self.lines[-1]


def looking_on(tmp_path: Path, told: Told, program: str) -> Onlooker:
    """Return a process that runs a program in Python."""
    command = (sys.executable, "-c", program, str(tmp_path / "heard"))
    return Onlooker(command, os.environ, tmp_path / "log", told.take)


def test_it_hears_of_beginning_and_end(tmp_path: Path) -> None:
    """Its address is told to the user, and nothing else if it ends when it should."""
    told = Told()
    with looking_on(tmp_path, told, GOOD) as own:
        assert told.await_line() == "live view at http://there/"
        own.begin()
        own.end(["a window was missed"])
    heard = (tmp_path / "heard").read_text("utf-8").splitlines()
    assert heard == ['{"event": "begun"}', '{"event": "over", "verdict": ["a window was missed"]}']
    assert told.lines == ["live view at http://there/"]


def test_it_may_die(tmp_path: Path) -> None:
    """The user is told where to look; telling it more does no harm."""
    told = Told()
    with looking_on(tmp_path, told, "raise SystemExit('no port')") as own:
        assert told.await_line().startswith("the live view has ended, the run goes on; its log: ")
        for _ in range(3):
            own.begin()
            own.end("ok")
    assert (tmp_path / "log").read_text("utf-8") == "no port\n"
    assert len(told.lines) == 1


def test_it_may_hang(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It isn't waited for any longer than a little."""
    monkeypatch.setattr(onlooker, "_PATIENCE_S", 0.1)
    told = Told()
    with looking_on(tmp_path, told, DEAF) as own:
        told.await_line()
    assert own._process is not None
    assert own._process.returncode == -9
    assert len(told.lines) == 1


def test_it_may_not_even_start(tmp_path: Path) -> None:
    """The user is told why, and all else goes on."""
    told = Told()
    missing = Onlooker((str(tmp_path / "nothing"),), os.environ, tmp_path / "log", told.take)
    with missing as own:
        own.begin()
        own.end("ok")
    assert told.lines[0].startswith("no live view: ")
