"""Tests of ``tlcomm_tools.audit.guarantees.places``: everybody meets where it started."""

from dataclasses import replace

from support.hand_made_run import hand_made_records, hand_made_scenario
from tlcomm_core.method import Method
from tlcomm_core.units import nanoseconds
from tlcomm_tools.audit.findings import audit_run


def test_whoever_meets_where_it_started_is_fine() -> None:
    """Windows are kept as by a team, and places too."""
    found = audit_run(hand_made_scenario(), Method.STATIC, hand_made_records(), nanoseconds(25.0))
    assert found.violations == ()
    windows, places = found.guarantees
    assert (windows.figures["windows"], windows.figures["windows_kept"]) == (3, 3)
    assert places.figures == {"strategies": 3, "strategies_in_place": 3}


def test_a_place_is_that_of_a_cell() -> None:
    """An agent that starts anywhere in a cell meets in its middle."""
    scenario = hand_made_scenario()
    west = scenario.agents["west"].model_copy(update={"start": (3.1, 0.4, 0.0)})
    aside = scenario.model_copy(update={"agents": {**scenario.agents, "west": west}})
    found = audit_run(aside, Method.STATIC, hand_made_records(), nanoseconds(25.0))
    assert found.guarantees[1].violations == ()


def test_another_place_is_named() -> None:
    """With round, agent and distance, once however many hold it; a team's may be anywhere."""
    records = hand_made_records()
    for index, own in enumerate(records.strategies):
        if own.strategy.round == 2:
            east, west = own.strategy.strategies
            held = replace(own.strategy, strategies=(replace(east, x_m=3.25), west))
            records.strategies[index] = replace(own, strategy=held)
    scenario, end_ns = hand_made_scenario(), nanoseconds(25.0)
    assert audit_run(scenario, Method.STATIC, records, end_ns).violations == (
        "round 2: east meets 0.500 m from where it started",
    )
    assert audit_run(scenario, Method.TEAM, records, end_ns).violations == ()
