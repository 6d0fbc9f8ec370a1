"""A team of real processes in the corridor: whole runs, and runs that are broken on purpose."""

import os
import signal
from collections.abc import Callable
from pathlib import Path

import pytest

from support.gate import gate
from support.measuring_corridor import measuring_corridor
from support.processes import processes_of
from tlcomm_core.agent.channel import LOST
from tlcomm_core.errors import InputError
from tlcomm_core.game.solver import DEFAULT
from tlcomm_core.method import Method
from tlcomm_core.metrics.run import run_metrics
from tlcomm_core.mission import Mission
from tlcomm_core.pace import Pace, parse_pace
from tlcomm_core.records import event_log
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.model import Radio, Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate
from tlcomm_core.world.observation import Odometry
from tlcomm_tools.bag.reader import read_run
from tlcomm_tools.run import RunOptions, RunReport, run_mission
from tlcomm_tools.status import Status
from tlcomm_tools.verification.findings import verify
from tlcomm_tools.verification.recording import read_recording

CORRIDOR = Path(__file__).parents[2] / "scenarios" / "corridor.yaml"
SCENARIO = load_scenario(CORRIDOR)
LOCKSTEP = parse_pace("lockstep")
SHARED_MEMORY = "/dev/shm/fastrtps"  # noqa: S108 (what Fast DDS leaves behind)


def options_of(
    out: Path,
    rounds: int,
    pace: Pace = LOCKSTEP,
    scenario: Scenario = SCENARIO,
    method: Method = Method.TEAM,
) -> RunOptions:
    """Return a run of the corridor, or of another scenario."""
    return RunOptions(
        scenario=scenario,
        method=method,
        solver=DEFAULT,
        seed=0,
        pace=pace,
        rounds=rounds,
        until_s=None,
        out=out,
    )


def run_and_strike(out: Path, strike: Callable[[], None]) -> RunReport:
    """Begin a long run, and do something to it once it is on its way and its bag grows."""
    struck = False
    sizes = []

    def strike_once(_: float, meetings_ended: int) -> None:
        nonlocal struck
        sizes.append(sum(path.stat().st_size for path in (out / "bag").glob("*.mcap")))
        if meetings_ended and sizes[-1] > sizes[0] and not struck:
            struck = True
            strike()

    return run_mission(options_of(out, 10_000), strike_once)


def shared_segments(out: Path) -> list[str]:
    """Return the shared memory that the run's processes have mapped, and could leave behind."""
    maps = [Path(f"/proc/{pid}/maps").read_text(encoding="utf-8") for pid in processes_of(out)]
    return [line for text in maps for line in text.splitlines() if SHARED_MEMORY in line]


def process_of(out: Path, name: str) -> int:
    """Return the process id of an agent, the sim or the recorder."""
    role = f"process {name} " if name in {"sim", "recorder"} else f"agent --name {name} "
    (pid,) = processes_of(out, role)
    return pid


def odometry_key(odometry: Odometry) -> tuple[int, str]:
    """Order odometry as it was measured."""
    return odometry.stamp_ns, odometry.agent


@pytest.mark.parametrize(
    ("scenario", "rounds", "method"),
    [
        (SCENARIO, 2, Method.TEAM),
        (measuring_corridor(), 2, Method.TEAM),
        (gate(), 5, Method.TEAM),
        (SCENARIO, 4, Method.PAIRWISE),
        (SCENARIO, 2, Method.ALL_TIME),
    ],
    ids=["corridor", "field", "gate", "pairs", "turns"],
)
def test_lock_step_run_equals_the_simulation(
    tmp_path: Path, scenario: Scenario, rounds: int, method: Method
) -> None:
    """Over ROS the same decisions fall and the same poses and estimates are recorded, to the bit;
    all is well, the figures are equal, and the bag is enough to decide the same again.
    """
    segments: list[str] = []
    report = run_mission(
        options_of(tmp_path / "run", rounds, scenario=scenario, method=method),
        lambda *_: segments.extend(shared_segments(tmp_path)),
    )
    assert report.status is Status.FINE, report
    assert report.result["verdict"] == "ok"
    recorded = read_run(report.folder.bag).records
    left = simulate(Mission(Site.from_scenario(scenario), 0, rounds, None, method=method))
    expected = left.records
    assert list(event_log(recorded)) == list(event_log(expected))
    metrics = run_metrics(scenario, expected, method, left.sim_ns).document()
    assert report.result["metrics"]["team"] == metrics["team"]
    assert report.result["metrics"]["agents"] == metrics["agents"]
    assert sorted(recorded.odometry, key=odometry_key) == sorted(
        expected.odometry, key=odometry_key
    )
    assert recorded.connectivity == expected.connectivity
    assert recorded.messages_sent == expected.messages_sent
    assert recorded.bytes_sent == expected.bytes_sent
    assert recorded.messages_undelivered == expected.messages_undelivered
    assert sorted(recorded.estimates, key=repr) == sorted(expected.estimates, key=repr)
    assert bool(recorded.estimates) is (scenario.field is not None)
    assert verify(read_recording(report.folder.bag)).difference is None
    assert segments == []
    assert processes_of(tmp_path) == []


def test_lock_step_run_over_a_bad_radio_equals_the_simulation(tmp_path: Path) -> None:
    """With loss, jitter, copies and queues too the same falls, and the same goes unheard."""
    radio = Radio(
        loss=0.1, loss_at_range=0.4, jitter_s=0.05, duplication=0.1, bandwidth_bps=200_000.0
    )
    scenario = SCENARIO.model_copy(update={"radio": radio})
    report = run_mission(options_of(tmp_path / "run", 2, scenario=scenario), lambda *_: None)
    recorded = read_run(report.folder.bag).records
    assert verify(read_recording(report.folder.bag)).difference is None
    expected = simulate(Mission(Site.from_scenario(scenario), 0, 2, None)).records
    assert list(event_log(recorded)) == list(event_log(expected))
    assert recorded.messages_sent == expected.messages_sent
    assert recorded.bytes_sent == expected.bytes_sent
    assert recorded.messages_undelivered == expected.messages_undelivered
    lost = {name: counts[LOST] for name, counts in recorded.messages_undelivered.items()}
    assert min(lost.values()) > 10
    assert lost == {
        name: own["messages_undelivered"][LOST] for name, own in report.result["agents"].items()
    }


def test_free_run_meets(tmp_path: Path) -> None:
    """With a clock that runs by itself the team meets, agrees on the next meeting, and measures."""
    options = options_of(tmp_path / "run", 1, Pace(5.0), measuring_corridor())
    report = run_mission(options, lambda *_: None)
    assert report.status is Status.FINE, report
    assert report.result["communication"]["missed"] == 0
    recorded = read_run(report.folder.bag).records
    assert any(own.has_measurement for own in recorded.estimates)
    with pytest.raises(InputError, match=r"at pace 5\.0"):
        verify(read_recording(report.folder.bag))


@pytest.mark.parametrize("victim", [next(iter(SCENARIO.agents)), "sim", "recorder"])
def test_killed_process_is_named_and_the_bag_readable(tmp_path: Path, victim: str) -> None:
    """SIGKILL to any process ends the run by that name; what was recorded so far can be read."""
    out = tmp_path / "run"
    report = run_and_strike(out, lambda: os.kill(process_of(out, victim), signal.SIGKILL))
    assert report.status is Status.BROKEN
    assert report.failure is not None
    assert (report.failure.name, report.failure.reason) == (victim, "killed by SIGKILL")
    recorded = read_run(report.folder.bag).records
    assert recorded.odometry
    assert recorded.strategies
    assert processes_of(out) == []


def test_interrupted_run_leaves_nobody_and_a_whole_bag(tmp_path: Path) -> None:
    """Ctrl-C ends all processes, and the bag is closed as after any other run."""
    out = tmp_path / "run"
    report = run_and_strike(out, lambda: os.kill(os.getpid(), signal.SIGINT))
    assert report.status is Status.INTERRUPTED
    recorded = read_run(report.folder.bag)
    assert not recorded.damage
    assert recorded.records.odometry
    assert processes_of(out) == []
    for log in report.folder.logs.glob("*.log"):
        assert "Traceback" not in log.read_text(encoding="utf-8")
