"""Whether what was recorded is of the scenario's agents: what isn't is named, and left out.

``keep_members``  the records of the scenario's agents, and what is wrong with the others
"""

from collections import Counter
from collections.abc import Iterable, Iterator
from dataclasses import replace
from typing import Protocol, TypeVar

from tlcomm_core.game.strategy import TeamStrategy
from tlcomm_core.records import RunRecords, StrategyRecord

__all__ = ["keep_members"]


class _Owned(Protocol):
    @property
    def agent(self) -> str: ...


_Own = TypeVar("_Own", bound=_Owned)


def keep_members(records: RunRecords, agents: frozenset[str]) -> tuple[RunRecords, tuple[str, ...]]:
    """Return the records without those of strangers, and a line per kind and stranger.

    Odometry may be of other robots besides, which is no fault.
    """
    tasks, task_lines = _parted(records.tasks, agents, "task event")
    strategies, strategy_lines = _parted(records.strategies, agents, "strategy")
    timings, timing_lines = _parted(records.timings, agents, "round timing")
    estimates, estimate_lines = _parted(records.estimates, agents, "estimate")
    kept = replace(
        records,
        tasks=tasks,
        strategies=[own for own in strategies if _is_of_members(own.strategy, agents)],
        timings=timings,
        estimates=estimates,
        odometry=[own for own in records.odometry if own.agent in agents],
        heard=[own for own in records.heard if {own.agent, own.sender} <= agents],
    )
    strange = (*task_lines, *strategy_lines, *timing_lines, *estimate_lines)
    voices = {own.sender for own in records.heard} - agents
    return kept, (
        *strange,
        *_strange_strategies(strategies, agents),
        *(f"{name!r} is no agent of the scenario, and was heard" for name in sorted(voices)),
    )


def _parted(
    entries: Iterable[_Own], agents: frozenset[str], what: str
) -> tuple[list[_Own], list[str]]:
    """Return the members' own, and a line for each stranger."""
    kept: list[_Own] = []
    strange = Counter[str]()
    for entry in entries:
        if entry.agent in agents:
            kept.append(entry)
        else:
            strange[entry.agent] += 1
    return kept, [
        f"{name!r} is no agent of the scenario, and has {_counted(count, what)}"
        for name, count in sorted(strange.items())
    ]


def _counted(count: int, what: str) -> str:
    plural = f"{what[:-1]}ies" if what.endswith("y") else f"{what}s"
    return f"1 {what}" if count == 1 else f"{count} {plural}"


def _is_of_members(held: TeamStrategy, agents: frozenset[str]) -> bool:
    names = {own.agent for own in held.strategies}
    return bool(names) and names <= agents and len(names) == len(held.strategies)


def _strange_strategies(records: Iterable[StrategyRecord], agents: frozenset[str]) -> Iterator[str]:
    for record in records:
        held = record.strategy
        if not _is_of_members(held, agents):
            names = [own.agent for own in held.strategies]
            whom = f"{names!r}, not of one agent of the scenario each" if names else "nobody"
            when_s = record.stamp_ns * 1e-9
            yield f"{record.agent}: {when_s:.3f} s: round {held.round}: strategies of {whom}"
