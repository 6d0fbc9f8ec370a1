"""The sim's conductor in lock step, with members in process."""

import random
from pathlib import Path

import pytest

from support.gate import CLOSED_S, OPENED_S, SHUT_S, gate
from support.in_process_team import InProcessTeam
from support.measuring_corridor import measuring_corridor
from tlcomm_core.mission import Mission, create_world
from tlcomm_core.records import event_log
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.lockstep import LockStep
from tlcomm_core.world.observation import Occupancy
from tlcomm_sim.conductor import RECORDER
from tlcomm_sim.lockstep import LockStepConductor
from tlcomm_sim.outputs import Answer, Leave, Show, ShowClock, Tick, TickAgent, TickRecorder

CORRIDOR = Path(__file__).parents[3] / "scenarios" / "corridor.yaml"


@pytest.fixture(scope="module")
def gate_site() -> Site:
    """Return the hall whose doors close and open."""
    return Site.from_scenario(gate())


@pytest.fixture(scope="module")
def site() -> Site:
    """Return the corridor."""
    return Site.from_scenario(load_scenario(CORRIDOR))


def team_of(
    site: Site, *, rounds: int = 1, has_recorder: bool = True, seed: int = 0
) -> InProcessTeam:
    """Return members with a conductor for one run."""
    mission = Mission(site, 0, rounds, None)
    latency_ns = nanoseconds(site.scenario.communication.hop_latency_s)
    agents = tuple(site.scenario.agents)
    lockstep = LockStep(create_world(site, 0), agents, latency_ns, mission.stop)
    conductor = LockStepConductor(lockstep, agents, has_recorder=has_recorder)
    return InProcessTeam(site, conductor, random.Random(seed))  # noqa: S311 (no secrets)


def time_of(output: Show | ShowClock) -> int:
    """Return the time of what the sim shows."""
    return output.time_ns if isinstance(output, ShowClock) else output.observation.stamp_ns


@pytest.mark.parametrize("seed", range(3))
def test_order_of_arrival_changes_nothing(site: Site, seed: int) -> None:
    """However commands and answers overtake each other, the run is that of the other harness."""
    team = team_of(site, seed=seed)
    team.run()
    expected = simulate(Mission(site, 0, 1, None)).records
    assert list(event_log(team.records)) == list(event_log(expected))
    shown = [
        output.observation
        for output in team.outputs
        if isinstance(output, Show) and not isinstance(output.observation, Occupancy)
    ]
    assert sorted(map(repr, shown)) == sorted(map(repr, expected.odometry + expected.connectivity))


@pytest.mark.parametrize("seed", range(2))
def test_readings_and_estimates_are_those_of_the_other_harness(seed: int) -> None:
    """Each reading is shown once and counted, and agents make the same of them."""
    site = Site.from_scenario(measuring_corridor())
    team = team_of(site, rounds=2, seed=seed)
    team.run()
    expected = simulate(Mission(site, 0, 2, None)).records
    assert list(event_log(team.records)) == list(event_log(expected))
    assert len(expected.estimates) > 20
    assert sorted(team.records.estimates, key=repr) == sorted(expected.estimates, key=repr)


@pytest.mark.parametrize("seed", range(2))
def test_changes_of_the_map_are_those_of_the_other_harness(gate_site: Site, seed: int) -> None:
    """Each is shown once and counted, and the run is the same."""
    team = team_of(gate_site, rounds=5, seed=seed)
    team.run()
    expected = simulate(Mission(gate_site, 0, 5, None)).records
    assert list(event_log(team.records)) == list(event_log(expected))
    shown = [output.observation for output in team.outputs if isinstance(output, Show)]
    times_ns = [seen.stamp_ns for seen in shown if isinstance(seen, Occupancy)]
    assert times_ns == [nanoseconds(time_s) for time_s in (0.0, CLOSED_S, SHUT_S, OPENED_S)]


def test_end(site: Site) -> None:
    """At the end all agents are told, then the recorder, and then the sim leaves."""
    team = team_of(site)
    team.run()
    agents = [TickAgent] * len(site.scenario.agents)
    last = team.outputs[-len(agents) - 2 :]
    assert [type(output) for output in last] == [*agents, TickRecorder, Leave]
    stops = [o.tick.stop for o in team.outputs if isinstance(o, TickAgent | TickRecorder)]
    assert stops.index(True) == len(stops) - len(agents) - 1
    assert team.conductor.meetings_ended == 2


def test_end_without_recorder(site: Site) -> None:
    """Without a recorder nobody ticks it, and the sim leaves when all agents have answered."""
    team = team_of(site, has_recorder=False)
    team.run()
    assert isinstance(team.outputs[-1], Leave)
    assert not any(isinstance(output, TickRecorder) for output in team.outputs)


def test_clock_is_shown_every_tenth_of_a_second(site: Site) -> None:
    """The clock is shown at all multiples of 0.1 s, each before anything later and not before."""
    team = team_of(site)
    team.run()
    clocks = [output.time_ns for output in team.outputs if isinstance(output, ShowClock)]
    assert clocks == [index * 100_000_000 for index in range(len(clocks))]
    shown_ns = -1
    for output in team.outputs:
        if isinstance(output, ShowClock):
            shown_ns = output.time_ns
        elif isinstance(output, Show):
            assert 0 <= output.observation.stamp_ns - shown_ns < 100_000_000


def test_a_slow_run_ticks_the_recorder_by_wall_time(site: Site) -> None:
    """In the midst of a step the recorder is told of what was published before it, and once."""
    team = team_of(site)
    wall_ns = 0
    team.perform(team.conductor.begin(wall_ns))
    ticks: list[Tick] = []
    while len(ticks) < 20:
        wall_ns += 10**9
        shown = [own for own in team.outputs if isinstance(own, Show | ShowClock)]
        for output in team.conductor.pass_time(wall_ns):
            assert isinstance(output, TickRecorder)
            assert team.conductor.pass_time(wall_ns + 10**9) == []
            ticks.append(output.tick)
            told = ticks[-1].odometry_count + ticks[-1].connectivity_count
            told += ticks[-1].clock_count + ticks[-1].map_count
            assert told == sum(time_of(own) <= ticks[-1].time_ns for own in shown)
            answer = Answer(RECORDER, output.tick.sequence, True, None, 0, 0, 0, 0)
            team.conductor.take_answer(answer)
        team.deliver_one()
    assert [own.time_ns for own in ticks] == sorted({own.time_ns for own in ticks})


def test_silent_recorder_is_waited_for(site: Site) -> None:
    """When the recorder is two lots behind, the run waits, and says for whom."""
    team = team_of(site)
    team.answers_recorder = False
    team.run()
    assert team.conductor.awaited == (RECORDER,)
    assert sum(isinstance(output, TickRecorder) for output in team.outputs) == 1
    published = sum(counts.published for counts in team.counts.values())
    assert 600 <= team.seen.total() + published < 700


def test_missing_command_is_waited_for(site: Site) -> None:
    """An agent that says it has sent more commands than have arrived holds up the run."""
    team = team_of(site)
    conductor = team.conductor
    ticks = [output for output in conductor.begin(0) if isinstance(output, TickAgent)]
    agents = [tick.agent for tick in ticks]
    assert conductor.awaited == tuple(agents)
    for tick in ticks:
        commands = int(tick.agent == agents[0])
        answer = Answer(tick.agent, tick.tick.sequence, ready=True, commands=commands)
        assert conductor.take_answer(answer) == []
    assert conductor.awaited == (agents[0],)
    assert conductor.take_command(agents[0], 1.0, 0.0, 0)
    assert agents[0] not in conductor.awaited


def test_foreign_and_stale_answers_change_nothing(site: Site) -> None:
    """Answers to another tick, or by nobody known, don't complete a step."""
    team = team_of(site)
    conductor = team.conductor
    conductor.begin(0)
    awaited = conductor.awaited
    for name in (*awaited, RECORDER, "stranger"):
        assert conductor.take_answer(Answer(name, 0, ready=True)) == []
        assert conductor.take_answer(Answer(name, 99, ready=True)) == []
    assert conductor.awaited == awaited
