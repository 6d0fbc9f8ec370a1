"""Whether agreed meetings can be held."""

from dataclasses import replace

import pytest

from support.hand_made_run import END_S, hand_made_records, hand_made_scenario
from tlcomm_core.scenario.model import Change, Radio, Scenario
from tlcomm_tools.audit.evidence import Evidence
from tlcomm_tools.audit.plans import audit_plans


def found(
    scenario: Scenario | None = None, *, own: dict[str, float] | None = None, **team: object
) -> list[str]:
    """Return what is wrong once both hold round 2 with something else, in it or of west's."""
    records = hand_made_records()
    for index, record in enumerate(records.strategies):
        if record.strategy.round == 2:
            east, west = record.strategy.strategies
            changed = (east, replace(west, **(own or {})))
            held = replace(record.strategy, strategies=changed, **team)
            records.strategies[index] = replace(record, strategy=held)
    return list(audit_plans(Evidence.gather(scenario or hand_made_scenario(), records, END_S)))


@pytest.mark.parametrize(
    ("own", "team", "line"),
    [
        ({}, {}, None),
        ({}, {"communication_s": 30.0}, "t_c is 30.000 s, not in its window [20 s, 30 s)"),
        ({}, {"communication_s": 19.0}, "t_c is 19.000 s, not in its window [20 s, 30 s)"),
        ({"extra_travel_s": -0.5}, {}, "west's δ is -0.500000 s, less than 0"),
        (
            {},
            {"initial_potential_s": 5.0},
            "Φ is 6.000000 s, more than at first, 5.000000 s",
        ),
        ({}, {"bound_s": 6.5}, "Φ is 6.000000 s, less than its bound, 6.500000 s"),
        ({"x_m": 2.75}, {}, "its places aren't connected by links of 0.96 m"),
        (
            {"arrival_s": 7.2, "x_m": 3.75},
            {},
            (
                "west is to arrive at 7.200 s, but the 0.500 m from its last meeting take it "
                "until 7.500 s"
            ),
        ),
    ],
)
def test_one_thing_wrong(own: dict[str, float], team: dict[str, float], line: str | None) -> None:
    """Each is named once, with round, agent and figure."""
    assert found(None, own=own, **team) == ([] if line is None else [f"round 2: {line}"])


def test_a_place_in_an_obstacle_is_named() -> None:
    """Unless it was free on some map that the round may have been planned on."""
    good = hand_made_scenario()
    box = (3.0, 0.0, 3.5, 0.5)
    line = "round {}: west is to meet in an obstacle, at (3.250, 0.250) m"
    for boxes, changes, rounds in (
        ((box,), (), (1, 2, 3)),
        ((), (Change(at_s=0.5, obstacles_m=(box,)),), ()),
        ((box,), (Change(at_s=5.0, obstacles_m=()),), (1,)),
    ):
        update = {"obstacles_m": boxes, "changes": changes}
        workspace = good.workspace.model_copy(update=update)
        lines = found(good.model_copy(update={"workspace": workspace}))
        assert lines == [line.format(number) for number in rounds]


def test_where_sight_matters_a_wall_parts_places() -> None:
    """Only then."""
    good = hand_made_scenario()
    workspace = good.workspace.model_copy(update={"obstacles_m": ((3.4, 0.2, 3.6, 0.3),)})
    for asked, lines in ((False, 0), (True, 3)):
        radio = Radio(line_of_sight=asked)
        scenario = good.model_copy(update={"workspace": workspace, "radio": radio})
        assert len(found(scenario)) == lines
