"""The verb ``check`` on bags that were tampered with: each kind is caught by its right name."""

import json
import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from support.command import run
from support.hand_made_run import hand_made_records, hand_made_scenario, write_bag
from tlcomm_core.geometry import Pose
from tlcomm_core.records import HeardRecord, RunRecords, SaidRecord
from tlcomm_core.scenario.loader import dumps
from tlcomm_tools.bag.records import data_end

S = 1_000_000_000
HOP_NS = 5_000_000
DATA_END = data_end()


def shift_a_pose(records: RunRecords) -> None:
    """Put west 0.3 m further for one sample, in which it stands."""
    index = next(
        index
        for index, own in enumerate(records.odometry)
        if (own.agent, own.stamp_ns) == ("west", 22 * S)
    )
    moved = replace(records.odometry[index], pose=Pose(3.55, 0.25, 0.0))
    records.odometry[index] = moved


def cut_a_meeting(records: RunRecords) -> None:
    """Let west never come back to meet, but wait at its region."""
    records.odometry = [
        replace(own, pose=Pose(1.25, 0.25, 0.0), linear_mps=0.0)
        if own.agent == "west" and own.stamp_ns >= 5 * S
        else own
        for own in records.odometry
    ]


def act_outside(records: RunRecords) -> None:
    """Let east's region be another while it acts: it says that it picked where west did."""
    for index, own in enumerate(records.tasks):
        if own.agent == "east" and own.event.action and own.stamp_ns < 10 * S:
            event = replace(own.event, region="left")
            records.tasks[index] = replace(own, event=event)


def swap_a_strategy(records: RunRecords) -> None:
    """Let west hold for round 2 what it held for round 1, by another number."""
    strategies = [own for own in records.strategies if own.agent == "west"]
    first, second = strategies[0], strategies[1]
    swapped = replace(first.strategy, round=2)
    records.strategies[records.strategies.index(second)] = replace(second, strategy=swapped)


def drop_odometry(records: RunRecords) -> None:
    """Lose all of west's odometry."""
    records.odometry = [own for own in records.odometry if own.agent != "west"]


def drop_events(records: RunRecords) -> None:
    """Lose all of west's task events."""
    records.tasks = [own for own in records.tasks if own.agent != "west"]


def drop_strategies(records: RunRecords) -> None:
    """Lose all strategies of both."""
    records.strategies.clear()


def spoil_a_number(records: RunRecords) -> None:
    """Let one of east's poses be no number."""
    index = next(index for index, own in enumerate(records.odometry) if own.stamp_ns == 22 * S)
    bad = replace(records.odometry[index], agent="east", pose=Pose(math.nan, 0.25, 0.0))
    records.odometry[index] = bad


def hear_from_afar(records: RunRecords) -> None:
    """Let east say one more thing while it is at its region, and west hear it."""
    records.said.append(SaidRecord(5 * S, "east", "confirmation"))
    records.heard.append(HeardRecord(5 * S + HOP_NS, "west", "east", "confirmation", 5 * S))


def hear_what_nobody_said(records: RunRecords) -> None:
    """Let east hear what west might have said at a meeting."""
    records.heard.append(HeardRecord(21 * S + HOP_NS, "east", "west", "proposal", 21 * S))


def hear_too_soon(records: RunRecords) -> None:
    """Let west hear a second before what east says."""
    last = records.heard[-1]
    records.heard[-1] = replace(last, stamp_ns=last.said_ns - S)


def hear_again(records: RunRecords) -> None:
    """Let west hear the same twice, though nothing is doubled on its way."""
    records.heard.append(records.heard[-1])


@pytest.mark.parametrize(
    ("spoil", "check", "line"),
    [
        (
            shift_a_pose,
            "motion",
            (
                "west: 22.000 s: jumps by 0.300 m from where its velocity leads; "
                "2 times, at most 0.300 m"
            ),
        ),
        (
            cut_a_meeting,
            "method",
            "window 1: connected for 0.000 s from [10 s, 20 s) on, not 2 s",
        ),
        (
            act_outside,
            "actions",
            "east: 4.500 s: 'pick' done 5.000 m from 'left', whose radius is 0.3 m",
        ),
        (swap_a_strategy, "strategies", "round 2: west holds another strategy than east"),
        (drop_odometry, "records", "west: no odometry"),
        (drop_events, "records", "west: no task events in 25.000 s"),
        (drop_strategies, "strategies", "round 1: east holds no strategy"),
        (
            spoil_a_number,
            "records",
            "east: 22.000 s: odometry with nan, not a finite number, 1 in all",
        ),
        (
            hear_from_afar,
            "hearing",
            (
                "west: 5.005 s: heard 'confirmation' of east, said at 5.000 s, "
                "from 4.995 m away, out of range"
            ),
        ),
        (
            hear_what_nobody_said,
            "hearing",
            ("east: 21.005 s: heard 'proposal' of west, said at 21.000 s, which was never said"),
        ),
        (
            hear_too_soon,
            "hearing",
            ("west: 20.000 s: heard 'confirmation' of east, said at 21.000 s, before it was said"),
        ),
        (
            hear_again,
            "hearing",
            (
                "west: 21.005 s: heard 'confirmation' of east, said at 21.000 s, "
                "more often than it was said"
            ),
        ),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_tampering_is_caught(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    spoil: Callable[[RunRecords], None],
    check: str,
    line: str,
) -> None:
    """By the check that is for it, with agent, time and figure; the status is 1."""
    records = hand_made_records()
    spoil(records)
    write_bag(tmp_path / "bag", records)
    status, out, _ = run(capsys, "check", "bag", "--json")
    found = json.loads(out)
    assert status == 1
    assert line in found["checks"][check]
    assert line in found["verdict"]


def test_what_was_heard_may_be_missing(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """As in bags from before it was recorded: that isn't available, and never passed silently."""
    records = hand_made_records()
    records.heard.clear()
    records.heard_until_ns.clear()
    write_bag(tmp_path / "bag", records)
    status, out, _ = run(capsys, "check", "bag")
    reason = "nothing recorded of what agents heard"
    assert (status, f"\nnot available: hearing: {reason}\n" in out) == (0, True)
    found = json.loads(run(capsys, "check", "bag", "--json")[1])
    assert found["checks"]["hearing"] is None
    assert found["unavailable"]["hearing"] == [reason]


def test_a_truncated_file_is_caught(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What is left of it is audited, and the bag called damaged."""
    path = write_bag(tmp_path / "bag", hand_made_records()).path
    data = path.read_bytes()
    path.write_bytes(data[: data.index(DATA_END)])
    status, out, _ = run(capsys, "check", "bag", "--json")
    assert status == 1
    assert json.loads(out)["checks"]["bag"][0].startswith("the bag is damaged: ")


def test_a_bag_of_an_older_format_is_audited(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """One without notes on method and scenario, given which: the same verdict as today's."""
    write_bag(tmp_path / "bag", hand_made_records(), with_scenario=False)
    (tmp_path / "line.yaml").write_text(dumps(hand_made_scenario()), "utf-8")
    status, out, _ = run(capsys, "check", "bag", "--scenario", "line.yaml")
    assert (status, out.splitlines()[-1]) == (0, "verdict: ok")
