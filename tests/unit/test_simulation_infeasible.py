"""Whole missions in which a window can't be met."""

import pytest

from tlcomm_core.errors import InfeasibleRoundError
from tlcomm_core.method import Method
from tlcomm_core.mission import Mission
from tlcomm_core.records import TaskRecord
from tlcomm_core.result import RunFacts, result_document
from tlcomm_core.scenario.loader import loads
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import Simulated, simulate
from tlcomm_core.units import seconds

TEXT = """
name: press
workspace:
  size_m: [4.0, 2.0]
  cell_m: 0.5
  regions:
    west: {{at_m: [0.25, 0.25], radius_m: 0.2}}
    press: {{at_m: [3.75, 0.25], radius_m: 0.2}}
communication: {{range_m: 1.0, period_s: 30.0, duration_s: 3.0, on_infeasible: {rule}}}
motion: {{linear_mps: 1.0, angular_radps: 1.5}}
actions: {{look: 2.0, form: 70.0}}
agents:
  short: {{start: [1.75, 0.25, 0.0], task: "G F (west & look)"}}
  long: {{start: [2.25, 0.25, 0.0], task: "G F (press & form)"}}
"""


def mission(rule: str, until_s: float) -> tuple[Scenario, Simulated]:
    """Run a team, one action of which takes longer than two windows."""
    scenario = loads(TEXT.format(rule=rule), "the text")
    return scenario, simulate(Mission(Site.from_scenario(scenario), 0, None, until_s))


def faults(left: Simulated, agent: str) -> list[TaskRecord]:
    """Return what an agent reported as a fault for want of a meeting."""
    return [
        record
        for record in left.records.tasks
        if record.agent == agent and record.event.detail.startswith("infeasible=")
    ]


def communication(scenario: Scenario, left: Simulated) -> dict[str, object]:
    """Return which windows were kept."""
    facts = RunFacts(Method.TEAM, "best-response", 0, "lockstep", seconds(left.sim_ns), 1.0)
    kept: dict[str, object] = result_document(scenario, left.records, facts)["communication"]
    return kept


def test_a_team_that_waits_keeps_its_windows() -> None:
    """Everybody says before driving who can't be there and why, and stays together."""
    scenario, left = mission("wait", 200.0)
    kept = communication(scenario, left)
    assert (kept["missed"], kept["windows"]) == (0, 7)
    for agent in ("short", "long"):
        first = faults(left, agent)[0]
        assert "for long" in first.event.detail
        assert "long's next step takes until 10" in first.event.detail
        assert first.event.is_coped_with
    since_ns = max(faults(left, agent)[0].stamp_ns for agent in ("short", "long"))
    moved = [own for own in left.records.odometry if own.linear_mps and own.stamp_ns > since_ns]
    assert moved == []


def test_a_team_that_skips_gives_up_one_window_for_its_tasks() -> None:
    """It meets in the next one that it can meet in, and the press gets its work."""
    scenario, left = mission("skip", 200.0)
    kept = communication(scenario, left)
    assert kept["missed_rounds"] == [2, 5]
    held = {record.strategy.round for record in left.records.strategies}
    assert {2, 5} & held == set()
    assert {1, 3, 6} <= held
    satisfied = [r for r in left.records.tasks if r.event.kind.name == "TASK_SATISFIED"]
    assert "long" in {record.agent for record in satisfied}


def test_a_team_that_stops_says_who_and_why() -> None:
    """The error is one line for people."""
    with pytest.raises(InfeasibleRoundError, match=r"for long; long's next step takes until 10\d"):
        mission("stop", 200.0)
