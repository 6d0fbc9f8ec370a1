"""A whole team in a hall whose doors close and open."""

from functools import cache

import numpy as np
import pytest

from support.gate import CLOSED_S, OPENED_S, SHUT_S, gate
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.game.solver import BEST_RESPONSE
from tlcomm_core.method import Method
from tlcomm_core.mission import Mission
from tlcomm_core.records import event_log
from tlcomm_core.result import RunFacts, result_document
from tlcomm_core.scenario.site import Site, later_grids
from tlcomm_core.simulation import Simulated, simulate
from tlcomm_core.units import seconds

END_S = 330.0


def run() -> Simulated:
    """Return a new run."""
    return simulate(Mission(Site.from_scenario(gate()), 0, None, END_S, BEST_RESPONSE))


@cache
def left() -> Simulated:
    """Return what the run leaves."""
    return run()


def faults() -> list[tuple[float, str]]:
    """Return time and detail of each fault."""
    return [
        (seconds(record.stamp_ns), record.event.detail)
        for record in left().records.tasks
        if record.event.kind is TaskEventKind.FAULT
    ]


def test_every_window_is_kept_and_nobody_runs_into_a_door() -> None:
    """Though agents are on their way when the doors close, and in two rooms for a while."""
    facts = RunFacts(Method.TEAM, "coalition", 0, "lockstep", END_S, None)
    result = result_document(gate(), left().records, facts)
    assert result["verdict"] == "ok"
    assert result["communication"]["satisfied"] == END_S // 30.0
    assert left().collisions == {"one": 0, "two": 0}
    assert all(own["tasks_satisfied"] >= 5 for own in result["agents"].values())


@pytest.mark.parametrize(("number", "until_s"), [(0, SHUT_S), (1, OPENED_S)])
def test_odometry_stays_out_of_what_is_closed(number: int, until_s: float) -> None:
    """As long as it is."""
    scenario = gate()
    since_s = (CLOSED_S, SHUT_S)[number]
    grid = later_grids(scenario.workspace)[number]
    places_m = np.array(
        [
            (seen.pose.x_m, seen.pose.y_m)
            for seen in left().records.odometry
            if since_s <= seconds(seen.stamp_ns) < until_s
        ]
    )
    assert len(places_m) > 20
    assert not [place for place in places_m.tolist() if grid.location_at(*place) is None]


def test_who_is_cut_off_says_so_and_goes_on_when_the_door_opens() -> None:
    """From its room it goes as near as it can, finds no plan, and comes when the way is open."""
    assert [detail.split("=")[0] for _, detail in faults()].count("cut_off_m") == 1
    assert {detail.split("=")[0] for _, detail in faults()} == {"cut_off_m", "blocked"}
    assert all(SHUT_S <= time_s < OPENED_S for time_s, _ in faults())
    reached = [
        (record.agent, seconds(record.stamp_ns))
        for record in left().records.tasks
        if record.event.kind is TaskEventKind.MEETING_REACHED and record.event.round == 4
    ]
    assert [agent for agent, _ in reached].count("one") == 2
    assert reached[-1][1] > OPENED_S


def test_a_run_is_a_function_of_scenario_and_seed() -> None:
    """Twice the same, to the byte."""
    assert list(event_log(run().records)) == list(event_log(left().records))
