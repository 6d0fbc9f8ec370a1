"""What is wrong with a run, in lines for people.

``failures``    all that makes a verdict other than "ok"
``patience_s``  how long a task may go without being satisfied
"""

import re
from collections import defaultdict
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Final

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.game.strategy import TeamStrategy
from tlcomm_core.method import Method
from tlcomm_core.metrics.connection import connected_intervals, pair_windows_of
from tlcomm_core.metrics.satisfaction import satisfied_ns
from tlcomm_core.records import RunRecords
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.scenario.task import read_automaton
from tlcomm_core.units import nanoseconds, seconds
from tlcomm_core.windows import Window

__all__ = ["failures", "patience_s"]

_SPARE_WINDOWS: Final = 2

# A round, and who is to meet in it, sorted.
_Meeting = tuple[int, tuple[str, ...]]


def failures(
    scenario: Scenario,
    records: RunRecords,
    method: Method,
    windows: Sequence[Window],
    end_ns: int,
) -> list[str]:
    """Return what is wrong with a run: starving tasks, disagreements, faults, missed windows.

    A missed window is wrong if the method promises to keep it, by the whole team or by a pair; any
    break of the connection if it promises that there is none.

    Args:
        scenario: what was run.
        records: what happened, each list in order of time.
        method: of coordination.
        windows: the outcomes of its windows.
        end_ns: when it ended.
    """
    duration_s = scenario.communication.duration_s
    missed = [window for window in windows if method.keeps_windows and not window.satisfied]
    by_pairs = _missed_by_pairs(scenario, records, end_ns) if method is Method.PAIRWISE else ()
    return [
        *(_missed(window, duration_s) for window in missed),
        *by_pairs,
        *(_parted(records, end_ns) if method.goes_together else ()),
        *_unsatisfied(scenario, records, method, end_ns),
        *_disagreements(scenario, records),
        *_faults(records),
    ]


def patience_s(scenario: Scenario, agent: str, method: Method = Method.TEAM) -> float:
    """Return the longest that an agent's task may go without being satisfied, if nothing fails.

    Every window leaves time for at least one more action of the task; two windows are spare. A
    given automaton is taken to need an action per state. Where all lead by turns, everything takes
    as many times longer as there are agents.
    """
    own = scenario.agents[agent]
    if own.automaton is not None:
        actions = read_automaton(own.automaton).state_count
    else:
        words = re.findall(r"\w+", own.whole_task)
        actions = sum(word in scenario.actions_of(agent) for word in words)
    leaders = len(scenario.agents) if method.goes_together else 1
    return leaders * (actions + _SPARE_WINDOWS) * scenario.communication.period_s


def _failed_ns(agent: str, records: RunRecords) -> Iterator[int]:
    return (
        record.stamp_ns
        for record in records.tasks
        if record.agent == agent and record.event.is_failed_attempt
    )


def _missed(window: Window, duration_s: float, by: str = "") -> str:
    longest_s = seconds(window.longest_ns)
    return (
        f"window {window.round} missed{by}: connected for {longest_s:.3f} s at most, "
        f"not {duration_s:g} s"
    )


def _parted(records: RunRecords, end_ns: int) -> Iterator[str]:
    """Say when the team was first not connected, and until when."""
    connected_ns = connected_intervals(records.connectivity, end_ns)
    moments_ns = [0, *(moment for interval in connected_ns for moment in interval), end_ns]
    for parted_ns, joined_ns in zip(moments_ns[::2], moments_ns[1::2], strict=True):
        if parted_ns < joined_ns:
            yield f"not connected from {seconds(parted_ns):.3f} s to {seconds(joined_ns):.3f} s"
            return


def _missed_by_pairs(scenario: Scenario, records: RunRecords, end_ns: int) -> Iterator[str]:
    duration_s = scenario.communication.duration_s
    for pair, windows in pair_windows_of(scenario, records, end_ns).items():
        for window in windows:
            if not window.satisfied:
                yield _missed(window, duration_s, f" by {' and '.join(pair.members)}")


def _unsatisfied(
    scenario: Scenario, records: RunRecords, method: Method, end_ns: int
) -> Iterator[str]:
    """Say whose task went unsatisfied too long; each failed attempt may have cost a window.

    How long another task than the scenario's may take isn't known.
    """
    changed = {r.agent for r in records.tasks if r.event.kind is TaskEventKind.TASK_CHANGED}
    for agent in (name for name in scenario.agents if name not in changed):
        moments_ns = [0, *satisfied_ns(agent, records), end_ns]
        start_ns, stop_ns = max(pairwise(moments_ns), key=lambda gap: gap[1] - gap[0])
        failed = sum(start_ns < time_ns <= stop_ns for time_ns in _failed_ns(agent, records))
        limit_s = patience_s(scenario, agent, method) + failed * scenario.communication.period_s
        if stop_ns - start_ns > nanoseconds(limit_s):
            yield (
                f"{agent}: task not satisfied from {seconds(start_ns):.3f} s "
                f"to {seconds(stop_ns):.3f} s"
            )


def _disagreements(scenario: Scenario, records: RunRecords) -> Iterator[str]:
    """Say which meetings not all members hold the same strategy of; a last one may be incomplete.

    Who reported that it lacks the others' confirmations does as all do, and holds nothing.
    """
    reported = {(r.event.disputed_round, r.agent) for r in records.tasks}
    held: dict[_Meeting, dict[str, set[TeamStrategy]]] = defaultdict(lambda: defaultdict(set))
    for record in records.strategies:
        held[record.strategy.round, record.strategy.members][record.agent].add(record.strategy)
    last = max((number for number, _ in held), default=0)
    for (number, members), by_agent in sorted(held.items(), key=lambda item: item[0]):
        is_whole = frozenset(members) == scenario.agents.keys()
        meeting = f"round {number}" if is_whole else f"round {number} of {', '.join(members)}"
        if len(set[TeamStrategy]().union(*by_agent.values())) > 1:
            yield f"{meeting}: agents hold different strategies"
        lacking = [name for name in members if name not in by_agent]
        missing = ", ".join(name for name in lacking if (number, name) not in reported)
        if missing and number < last:
            yield f"{meeting}: not held by {missing}"


def _faults(records: RunRecords) -> Iterator[str]:
    for record in records.tasks:
        if record.event.kind is TaskEventKind.FAULT and not record.event.is_coped_with:
            time_s = seconds(record.stamp_ns)
            yield f"{record.agent}: fault at {time_s:.3f} s: {record.event.detail}"
