"""The supervisor of processes, tried on small programs that need no ROS."""

import os
import select
import signal
import subprocess
import sys
import textwrap
import threading
from collections.abc import Callable
from pathlib import Path

import pytest

from tlcomm_tools.runtime.notify import Note, Progress, Ready
from tlcomm_tools.runtime.supervisor import (
    Deadlines,
    ProcessSpec,
    RunFailed,
    RunFinished,
    RunInterrupted,
    run_processes,
)

PRELUDE = """
import os, signal, sys, threading
from tlcomm_tools.runtime.notify import *
notifier = Notifier.from_environment()
tell = notifier.tell
watch_parent()
def wait():
    threading.Event().wait()
"""
QUICK = Deadlines(start_s=10.0, progress_s=10.0, finish_s=10.0, interrupt_s=0.3, terminate_s=0.3)


@pytest.fixture
def make(tmp_path: Path) -> Callable[..., ProcessSpec]:
    """Return a maker of processes from Python text."""

    def make_spec(name: str, text: str, *, stop_last: bool = False) -> ProcessSpec:
        program = PRELUDE + textwrap.dedent(text)
        command = (sys.executable, "-c", program, str(tmp_path))
        return ProcessSpec(name, command, tmp_path / f"{name}.log", stop_last)

    return make_spec


class Heard:
    """Notes in order, and a hook that acts on them."""

    def __init__(self, hook: Callable[[str, Note], None] = lambda *_: None) -> None:
        self.notes: list[tuple[str, Note]] = []
        self.hook = hook

    def __call__(self, name: str, note: Note) -> None:
        """Note a note."""
        self.notes.append((name, note))
        self.hook(name, note)


def environment() -> dict[str, str]:
    """Return an environment in which children import what this process does."""
    return {**os.environ, "PYTHONPATH": os.pathsep.join(path for path in sys.path if path)}


def ends(pid: int) -> bool:
    """Wait until a process has ended, at most 10 s."""
    try:
        fd = os.pidfd_open(pid)
    except ProcessLookupError:
        return True
    try:
        return bool(select.select([fd], [], [], 10.0)[0])
    finally:
        os.close(fd)


def test_finished_processes_finish_the_run(make: Callable[..., ProcessSpec]) -> None:
    """A run whose processes all say that they are finished and exit 0 has finished."""
    text = "tell(Ready()); tell(Progress(1.5, 2)); tell(Finished())"
    heard = Heard()
    outcome = run_processes([make("a", text), make("b", text)], environment(), heard, QUICK)
    assert outcome == RunFinished()
    assert ("a", Ready()) in heard.notes
    assert ("b", Progress(1.5, 2)) in heard.notes


def test_killed_process_is_named(make: Callable[..., ProcessSpec], tmp_path: Path) -> None:
    """SIGKILL to one process fails the run by that name and signal, with its log's last lines."""
    victim = """
        for line in range(30): print("line", line, flush=True)
        (lambda p: open(p, "w").write(str(os.getpid())))(sys.argv[1] + "/pid")
        tell(Ready()); wait()
    """

    def kill(name: str, note: Note) -> None:
        if name == "victim" and note == Ready():
            os.kill(int((tmp_path / "pid").read_text(encoding="ascii")), signal.SIGKILL)

    specs = [make("other", "tell(Ready()); wait()"), make("victim", victim)]
    outcome = run_processes(specs, environment(), Heard(kill), QUICK)
    tail = tuple(f"line {line}" for line in range(15, 30))
    assert outcome == RunFailed("victim", "killed by SIGKILL", 3, tail)


def test_early_exit_is_a_failure(make: Callable[..., ProcessSpec]) -> None:
    """A process that exits 0 without having said that it is finished breaks the run."""
    specs = [make("a", "tell(Ready())"), make("b", "tell(Ready()); wait()")]
    outcome = run_processes(specs, environment(), Heard(), QUICK)
    assert outcome == RunFailed("a", "ended before the run was over", 3, ())


def test_stated_reason_wins_over_the_exit_status(make: Callable[..., ProcessSpec]) -> None:
    """What a process says of its failure is what is reported, with its status."""
    text = "tell(Failed('agent_2 did not answer', 2)); sys.exit(1)"
    outcome = run_processes([make("sim", text)], environment(), Heard(), QUICK)
    assert isinstance(outcome, RunFailed)
    assert (outcome.name, outcome.reason, outcome.status) == ("sim", "agent_2 did not answer", 2)


def test_missing_program_is_named(tmp_path: Path) -> None:
    """A program that isn't there is a failure of that process, not a traceback."""
    spec = ProcessSpec("ghost", (str(tmp_path / "ghost"),), tmp_path / "ghost.log")
    outcome = run_processes([spec], environment(), Heard(), QUICK)
    assert isinstance(outcome, RunFailed)
    assert (outcome.name, outcome.status) == ("ghost", 3)


@pytest.mark.parametrize(
    ("texts", "limits", "name", "reason"),
    [
        (["tell(Ready()); wait()", "wait()"], {"start_s": 3.0}, "p1", "not started within 3 s"),
        (
            ["tell(Ready()); wait()", "tell(Started()); wait()"],
            {"start_s": 3.0},
            "p1",
            "the others not found within 3 s",
        ),
        (
            ["tell(Ready()); wait()", "tell(Ready()); tell(Progress(1, 1)); wait()"],
            {"progress_s": 1.0},
            "p1",
            "no progress for 1 s",
        ),
        (
            ["tell(Ready()); tell(Finished())", "tell(Ready()); wait()"],
            {"finish_s": 2.0},
            "p1",
            "not ended 2 s after the run was over",
        ),
    ],
)
def test_deadlines(
    make: Callable[..., ProcessSpec],
    texts: list[str],
    limits: dict[str, float],
    name: str,
    reason: str,
) -> None:
    """A process that doesn't start, find the others, progress or end in time is named."""
    specs = [make(f"p{index}", text) for index, text in enumerate(texts)]
    deadlines = Deadlines(**{"interrupt_s": 0.2, "terminate_s": 0.2, **limits})
    outcome = run_processes(specs, environment(), Heard(), deadlines)
    assert isinstance(outcome, RunFailed)
    assert (outcome.name, outcome.reason, outcome.status) == (name, reason, 3)


def test_escalation_and_order(make: Callable[..., ProcessSpec], tmp_path: Path) -> None:
    """A process deaf to SIGINT and SIGTERM is killed, and only then the last one interrupted."""
    deaf = """
        signal.signal(signal.SIGINT, lambda *_: os.write(1, b"SIGINT "))
        signal.signal(signal.SIGTERM, lambda *_: os.write(1, b"SIGTERM "))
        tell(Ready()); wait()
    """
    recorder = """
        def leave(*_):
            others = os.listdir(sys.argv[1])
            alive = os.path.exists("/proc/" + open(sys.argv[1] + "/deaf.pid").read())
            print("deaf lives" if alive else "closed after deaf"); sys.exit()
        signal.signal(signal.SIGINT, leave)
        tell(Ready()); wait()
    """
    deaf = '(lambda p: open(p, "w").write(str(os.getpid())))(sys.argv[1] + "/deaf.pid")\n' + (
        textwrap.dedent(deaf)
    )
    specs = [make("recorder", recorder, stop_last=True), make("deaf", deaf)]
    ready: set[str] = set()

    def interrupt(name: str, _: Note) -> None:
        ready.add(name)
        if len(ready) == len(specs):
            os.kill(os.getpid(), signal.SIGINT)

    outcome = run_processes(specs, environment(), Heard(interrupt), QUICK)
    assert outcome == RunInterrupted()
    assert (tmp_path / "deaf.log").read_text(encoding="ascii") == "SIGINT SIGTERM "
    assert (tmp_path / "recorder.log").read_text(encoding="ascii") == "closed after deaf\n"


def test_grandchildren_go_too(make: Callable[..., ProcessSpec], tmp_path: Path) -> None:
    """What a process started and left running is ended with it."""
    text = """
        import subprocess
        child = subprocess.Popen(["sleep", "600"])
        (lambda p: open(p, "w").write(str(child.pid)))(sys.argv[1] + "/pid")
        tell(Finished())
    """
    assert run_processes([make("a", text)], environment(), Heard(), QUICK) == RunFinished()
    assert ends(int((tmp_path / "pid").read_text(encoding="ascii")))


def test_signal_handlers_are_restored(make: Callable[..., ProcessSpec]) -> None:
    """After a run SIGINT means again what it meant before."""
    before = signal.getsignal(signal.SIGINT)
    run_processes([make("a", "tell(Finished())")], environment(), Heard(), QUICK)
    assert signal.getsignal(signal.SIGINT) is before


def test_other_threads_may_supervise(make: Callable[..., ProcessSpec]) -> None:
    """Outside the main thread, where no signal can be handled, a run works all the same."""
    outcomes: list[object] = []
    specs = [make("a", "tell(Finished())")]
    thread = threading.Thread(
        target=lambda: outcomes.append(run_processes(specs, environment(), Heard(), QUICK))
    )
    thread.start()
    thread.join(20.0)
    assert outcomes == [RunFinished()]


def test_closed_pipe_does_not_spin(make: Callable[..., ProcessSpec]) -> None:
    """A process that closes its pipe and lives on costs the supervisor no computing."""
    text = """
        fd = notifier._fd
        tell(Ready()); os.close(fd); wait()
    """
    deadlines = Deadlines(progress_s=0.5, interrupt_s=0.2, terminate_s=0.2)
    before_s = sum(os.times()[:2])
    outcome = run_processes([make("a", text)], environment(), Heard(), deadlines)
    assert isinstance(outcome, RunFailed)
    assert outcome.reason == "no progress for 0.5 s"
    assert sum(os.times()[:2]) - before_s < 0.25


def test_killed_supervisor_leaves_nobody(make: Callable[..., ProcessSpec], tmp_path: Path) -> None:
    """Processes of a supervisor that was killed itself end by themselves."""
    text = """
        (lambda p: open(p, "w").write(str(os.getpid())))(sys.argv[1] + "/pid")
        tell(Ready()); wait()
    """
    spec = make("a", text)
    program = f"""
from pathlib import Path
import os
from tlcomm_tools.runtime.supervisor import *
spec = ProcessSpec({spec.name!r}, {spec.command!r}, Path({str(spec.log)!r}))
run_processes([spec], os.environ, lambda *_: os.kill(os.getpid(), 9))
"""
    supervisor = subprocess.run(
        [sys.executable, "-c", program], env=environment(), check=False, timeout=20.0
    )
    assert supervisor.returncode == -signal.SIGKILL
    assert ends(int((tmp_path / "pid").read_text(encoding="ascii")))
