"""Whether what was recorded is of the scenario's agents."""

from dataclasses import replace

from support.hand_made_run import AGENTS, hand_made_records
from tlcomm_core.records import EstimateRecord, HeardRecord
from tlcomm_tools.audit.membership import keep_members

TEAM = frozenset(AGENTS)


def test_the_teams_records_are_kept_as_they_are() -> None:
    """Nothing is named, nothing left out."""
    records = hand_made_records()
    assert keep_members(records, TEAM) == (records, ())


def test_strangers_are_named_and_left_out() -> None:
    """Per kind and stranger, by a name that a terminal shows as it is; other robots may drive."""
    records = hand_made_records()
    expected = hand_made_records()
    records.odometry.append(replace(records.odometry[0], agent="forklift"))
    records.tasks += [replace(records.tasks[0], agent="\x1b[31m")] * 2
    records.timings.append(replace(records.timings[0], agent="ghost"))
    records.estimates.append(EstimateRecord(0, "ghost", 1.0, 1.0, has_measurement=True))
    records.heard.append(HeardRecord(2, "east", "ghost", "proposal", 1))
    held = records.strategies[0]
    strange = tuple(replace(own, agent="ghost") for own in held.strategy.strategies[:1])
    twice = held.strategy.strategies[:1] * 2
    records.strategies += [
        replace(held, agent="ghost"),
        replace(held, strategy=replace(held.strategy, strategies=strange)),
        replace(held, strategy=replace(held.strategy, strategies=())),
        replace(held, strategy=replace(held.strategy, strategies=twice)),
    ]
    kept, lines = keep_members(records, TEAM)
    assert kept == replace(expected, heard=kept.heard)
    assert "ghost" not in {own.sender for own in kept.heard}
    assert lines == (
        r"'\x1b[31m' is no agent of the scenario, and has 2 task events",
        "'ghost' is no agent of the scenario, and has 1 strategy",
        "'ghost' is no agent of the scenario, and has 1 round timing",
        "'ghost' is no agent of the scenario, and has 1 estimate",
        "east: 1.000 s: round 1: strategies of ['ghost'], not of one agent of the scenario each",
        "east: 1.000 s: round 1: strategies of nobody",
        (
            "east: 1.000 s: round 1: strategies of ['east', 'east'], "
            "not of one agent of the scenario each"
        ),
        "'ghost' is no agent of the scenario, and was heard",
    )
