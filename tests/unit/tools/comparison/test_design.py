"""Which runs a comparison has."""

from dataclasses import replace
from pathlib import Path

import pytest

from tlcomm_core.errors import InputError
from tlcomm_core.game.solver import DEFAULT
from tlcomm_core.method import Method
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_tools.comparison.design import Design, jobs_of
from tlcomm_tools.comparison.sweep import Sweep

SCENARIOS = Path(__file__).parents[4] / "scenarios"
DESIGN = Design(
    scenario=load_scenario(SCENARIOS / "corridor.yaml"),
    methods=None,
    seeds=2,
    rounds=5,
    until_s=None,
    solver=DEFAULT,
    sweep=None,
    with_processes=False,
)


def test_by_default_all_methods_are_compared() -> None:
    """The oracle too, in a small team."""
    assert [job.folder for job in jobs_of(DESIGN)] == [
        f"{method}-{seed}" for method in Method for seed in (0, 1)
    ]


def test_all_methods_have_the_same_scenarios_and_end() -> None:
    """When D_c after the last window is nearly over, as then each meeting in it is."""
    jobs = jobs_of(DESIGN)
    for seed in (0, 1):
        assert len({job.scenario for job in jobs if job.seed == seed}) == 1
    assert len({job.scenario for job in jobs}) == 2
    assert {job.until_s for job in jobs} == {6 * 30.0 + 2.9995}
    assert {job.until_s for job in jobs_of(replace(DESIGN, rounds=None, until_s=70.0))} == {70.0}


def test_only_the_first_seed_is_drawn() -> None:
    """Traces of the others would be kept for nothing."""
    assert {job.seed for job in jobs_of(DESIGN) if job.is_drawn} == {0}


def test_the_oracle_is_for_small_teams() -> None:
    """It is left out of a larger one, and refused if it is asked for."""
    large = replace(DESIGN, scenario=load_scenario(SCENARIOS / "warehouse.yaml"), seeds=1)
    assert Method.ORACLE not in {job.method for job in jobs_of(large)}
    with pytest.raises(InputError, match="20 agents"):
        jobs_of(replace(large, methods=(Method.TEAM, Method.ORACLE)))


def test_a_sweep_has_all_runs_at_each_value() -> None:
    """In folders of their own; each run is as long as its own windows."""
    design = replace(DESIGN, methods=(Method.NONE,), sweep=Sweep("period", (20.0, 40.5)), seeds=1)
    jobs = jobs_of(design)
    assert [(job.folder, job.value, job.until_s) for job in jobs] == [
        ("period-20/none-0", 20.0, 122.9995),
        ("period-40.5/none-0", 40.5, 245.9995),
    ]
    assert not any(job.is_drawn for job in jobs)


def test_terms_leave_room_for_more_runs() -> None:
    """Methods, seeds and values may be added; anything else makes other runs."""
    more = replace(DESIGN, methods=(Method.TEAM,), seeds=9)
    assert more.terms() == DESIGN.terms()
    assert replace(DESIGN, rounds=6).terms() != DESIGN.terms()
    assert replace(DESIGN, with_processes=True).terms() != DESIGN.terms()
