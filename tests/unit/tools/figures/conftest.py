"""A short run of the plant, and what is drawn of it."""

from pathlib import Path
from typing import Any

import pytest

from tlcomm_core.method import Method
from tlcomm_core.mission import Mission
from tlcomm_core.records import EstimateRecord
from tlcomm_core.result import RunFacts, result_document
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate
from tlcomm_core.units import nanoseconds, seconds
from tlcomm_tools.figures.courses import follow_courses
from tlcomm_tools.figures.trace import Trace

PLANT = Path(__file__).parents[4] / "scenarios" / "plant.yaml"


@pytest.fixture(scope="session")
def plant() -> Site:
    """Return the plant."""
    return Site.from_scenario(load_scenario(PLANT))


@pytest.fixture(scope="session")
def trace(plant: Site) -> Trace:
    """Return a trace of two rounds, their courses, and estimates that are one too high."""
    left = simulate(Mission(plant, seed=0, rounds=2, until_s=None))
    field = plant.scenario.field
    assert field is not None
    left.records.estimates[:] = [
        EstimateRecord(nanoseconds(time_s), agent, field.profile[0][1] + 1.0, 0.0, False)
        for time_s in (20.0, 80.0)
        for agent in ("agent_1", "agent_2")
    ]
    facts = RunFacts(Method.TEAM, "coalition", 0, "lockstep", seconds(left.sim_ns), 1.0)
    result: dict[str, Any] = result_document(plant.scenario, left.records, facts)
    courses = follow_courses(plant, 2, 0)
    return Trace.from_records(plant.scenario, "team", left.records, result, courses)
