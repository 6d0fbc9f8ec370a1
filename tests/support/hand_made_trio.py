"""Runs made by hand: three agents on a line, by pairs, led by turns, or each by itself.

Windows are 10 s, meetings 2 s and the range is 1 m. Their tasks are open to the end.
"""

from collections.abc import Sequence

import numpy as np

from support.hand_made_run import task
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.geometry import Pose
from tlcomm_core.records import RunRecords, StrategyRecord
from tlcomm_core.scenario.loader import loads
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.observation import Odometry

__all__ = [
    "TRIO",
    "by_pairs",
    "by_turns",
    "drive",
    "hold",
    "lone",
    "move",
    "trio_scenario",
]

TRIO = ("bow", "mid", "stern")
_HOME_M = {"bow": 1.25, "mid": 2.0, "stern": 2.75, "aft": 3.5}
_END_S = 45.0

_SCENARIO = """
name: trio
workspace:
  size_m: [8.0, 1.0]
  cell_m: 0.5
  regions: {dock: {at_m: [5.25, 0.25], radius_m: 0.3}}
communication: {range_m: 1.0, period_s: 10.0, duration_s: 2.0}
motion: {linear_mps: 1.0, angular_radps: 1.5}
actions: {pick: 1.0}
agents:
  bow: {start: [1.25, 0.25, 0.0], task: "F (dock & pick)"}
  mid: {start: [2.0, 0.25, 0.0], task: "F (dock & pick)"}
  stern: {start: [2.75, 0.25, 0.0], task: "F (dock & pick)"}
"""


def trio_scenario() -> Scenario:
    """Return the scenario."""
    return loads(_SCENARIO)


def by_pairs() -> RunRecords:
    """Return 45 s of pairs: bow and mid meet in windows 1 and 3, mid and stern in 2 and 4.

    In mid's windows with stern the two are 2 m from bow, and the other way round. What follows is
    agreed on at a meeting; the first meetings are at 0 s.
    """
    records = RunRecords()
    drive(records, "bow", [(0.0, 1.25), (_END_S, 1.25)])
    drive(records, "stern", [(0.0, 3.75), (_END_S, 3.75)])
    ways = [(0.0, 2.0), (13.0, 2.0), (14.0, 3.0), (23.0, 3.0), (24.0, 2.0), (33.0, 2.0)]
    drive(records, "mid", [*ways, (34.0, 3.0), (_END_S, 3.0)])
    pairs = (("bow", "mid"), ("mid", "stern"))
    for index, pair in enumerate(pairs):
        for window in range(index + 1, 7, 2):
            agreed_s = max(0.5, (window - 2) * 10.0 + 1.0)
            hold(records, agreed_s, pair, window, pair)
        for window in (0, *range(index + 1, 5, 2)):
            for agent in pair:
                end_s = window * 10.0 + 2.0
                ended = task(end_s, agent, TaskEventKind.MEETING_ENDED, round_=window)
                records.tasks.append(ended)
    return _sorted(records)


def by_turns() -> RunRecords:
    """Return 45 s of turns: each stays at its place, and picks for a second after the one before.

    Turn n is agreed on at 3·n s, and its leader picks from half a second later on.
    """
    records = lone()
    records.tasks.clear()
    for turn in range(1, 15):
        hold(records, 3.0 * turn, TRIO, turn, TRIO, comes_s=3.0 * turn + 2.0)
        leader = TRIO[(turn - 1) % len(TRIO)]
        _pick(records, leader, 3.0 * turn + 0.5, turn)
    return records


def lone() -> RunRecords:
    """Return 45 s in which nobody moves, and everybody picks at once."""
    records = RunRecords()
    for agent in TRIO:
        drive(records, agent, [(0.0, _HOME_M[agent]), (_END_S, _HOME_M[agent])])
        _pick(records, agent, 3.0)
    return _sorted(records)


def move(records: RunRecords, agent: str, waypoints: Sequence[tuple[float, float]]) -> None:
    """Let an agent have driven elsewhere; as ``drive``."""
    records.odometry = [own for own in records.odometry if own.agent != agent]
    drive(records, agent, waypoints)
    _sorted(records)


def drive(records: RunRecords, agent: str, waypoints: Sequence[tuple[float, float]]) -> None:
    """Add an agent's odometry: straight between points (t in s, x in m)."""
    times_s, places_m = np.array(waypoints).T
    for time_s in np.union1d(times_s, np.arange(0.0, times_s[-1], 0.5)).tolist():
        x_m, next_m = np.interp((time_s, time_s + 1e-3), times_s, places_m)
        pose = Pose(float(x_m), 0.25, 0.0)
        speed_mps = float(next_m - x_m) / 1e-3
        records.odometry.append(Odometry(nanoseconds(time_s), agent, pose, speed_mps, 0.0))


def hold(
    records: RunRecords,
    time_s: float,
    holders: Sequence[str],
    round_: int,
    members: Sequence[str],
    *,
    extra_s: float = 0.0,
    comes_s: float | None = None,
) -> None:
    """Let agents hold a strategy of some, who come at a time, or else 2 s before the window."""
    meet_s, early_s = (10.0 * round_, 2.0) if comes_s is None else (comes_s, 0.0)
    strategies = tuple(
        Strategy(name, _HOME_M[name], 0.25, 0, meet_s - early_s, extra_s) for name in members
    )
    total_s = (extra_s + early_s) * len(members)
    held = TeamStrategy(round_, 1, strategies, meet_s, total_s, total_s)
    records.strategies += [StrategyRecord(nanoseconds(time_s), name, held) for name in holders]


def _pick(records: RunRecords, agent: str, start_s: float, turn: int = 0) -> None:
    stop_s = start_s + 1.0
    records.tasks += [
        task(start_s, agent, TaskEventKind.ACTION_STARTED, action="pick", round_=turn),
        task(stop_s, agent, TaskEventKind.ACTION_FINISHED, action="pick", round_=turn),
    ]


def _sorted(records: RunRecords) -> RunRecords:
    for entries in (records.odometry, records.tasks, records.strategies):
        entries.sort(key=lambda entry: entry.stamp_ns)
    return records
