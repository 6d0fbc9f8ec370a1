"""Who agrees on what: on rounds, on meetings of pairs, or on turns.

``Agreement``      one thing agreed on
``agreements_of``  all of a run
"""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import assert_never

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.game.strategy import TeamStrategy
from tlcomm_core.method import Method
from tlcomm_core.records import StrategyRecord
from tlcomm_tools.audit.evidence import Evidence

__all__ = ["Agreement", "agreements_of"]

_Held = dict[str, list[TeamStrategy]]


@dataclass(frozen=True, slots=True)
class Agreement:
    """One thing agreed on.

    Attributes:
        name: how it is called.
        agents: who agree, whose strategies these are.
        held: what agents hold, by agent; nothing by those who hold none.
        owing: who must hold a strategy; of the others the run may have ended before they did.
        opens_s: the earliest time to communicate.
    """

    name: str
    agents: Sequence[str]
    held: Mapping[str, Sequence[TeamStrategy]]
    owing: frozenset[str]
    opens_s: float


def agreements_of(method: Method, evidence: Evidence) -> Iterator[Agreement]:
    """Yield what agents agree on by a method, or should have."""
    match method:
        case Method.TEAM | Method.STATIC | Method.ORACLE:
            yield from _rounds(evidence)
        case Method.PAIRWISE:
            yield from _pair_meetings(evidence)
        case Method.ALL_TIME:
            yield from _turns(evidence)
        case Method.NONE:
            return
        case _:
            assert_never(method)


def _rounds(evidence: Evidence) -> Iterator[Agreement]:
    """Yield the rounds that a strategy is held for, or that were to be agreed on.

    A round is owed by everybody if the meeting before it, where it is agreed on, has ended for all.
    """
    held = _held(evidence.records.strategies)
    ended = _meetings_ended(evidence)
    for number in sorted(set(held) | {own + 1 for own in ended}):
        owing = frozenset(evidence.agents) if number - 1 in ended else frozenset()
        opens_s = number * evidence.scenario.communication.period_s
        yield Agreement(f"round {number}", evidence.agents, held.get(number, {}), owing, opens_s)


def _meetings_ended(evidence: Evidence) -> set[int]:
    """Return the rounds whose meeting has ended for every agent."""
    ended: dict[int, set[str]] = defaultdict(set)
    for record in evidence.records.tasks:
        if record.event.kind is TaskEventKind.MEETING_ENDED:
            ended[record.event.round].add(record.agent)
    return {number for number, names in ended.items() if names >= set(evidence.agents)}


def _pair_meetings(evidence: Evidence) -> Iterator[Agreement]:
    """Yield the meetings of a few agents, by window.

    Where one has agreed on a meeting, the others have if a meeting of theirs has ended since.
    """
    meetings: dict[tuple[int, tuple[str, ...]], list[StrategyRecord]] = defaultdict(list)
    for record in evidence.records.strategies:
        names = tuple(sorted(own.agent for own in record.strategy.strategies))
        meetings[record.strategy.round, names].append(record)
    left_ns = _last_endings_ns(evidence)
    for (window, names), records in sorted(meetings.items()):
        agreed_ns = min(record.stamp_ns for record in records)
        yield Agreement(
            f"window {window}, {' and '.join(names)}",
            names,
            _held(records)[window],
            frozenset(name for name in names if left_ns.get(name, -1) >= agreed_ns),
            window * evidence.scenario.communication.period_s,
        )


def _last_endings_ns(evidence: Evidence) -> dict[str, int]:
    """Return when the last meeting of each agent has ended."""
    return {
        record.agent: record.stamp_ns
        for record in evidence.records.tasks
        if record.event.kind is TaskEventKind.MEETING_ENDED
    }


def _turns(evidence: Evidence) -> Iterator[Agreement]:
    """Yield the turns; the run may have ended while the last was being agreed on.

    Of turns in a row that nobody holds a strategy for, the first stands for all.
    """
    held = _held(evidence.records.strategies)
    last = max(held, default=0)
    for number in sorted(held.keys() | {own + 1 for own in held if own < last}):
        owing = frozenset(evidence.agents) if number < last else frozenset()
        yield Agreement(f"turn {number}", evidence.agents, held.get(number, {}), owing, 0.0)


def _held(strategies: Sequence[StrategyRecord]) -> dict[int, _Held]:
    """Return what agents hold for each round."""
    held: dict[int, _Held] = {}
    for record in strategies:
        of_round = held.setdefault(record.strategy.round, {})
        of_round.setdefault(record.agent, []).append(record.strategy)
    return held
