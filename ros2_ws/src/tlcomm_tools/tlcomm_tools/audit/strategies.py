"""Whether all agents hold the same strategy in each round, and one each.

``StrategyFinding``   what is held
``audit_strategies``  looks it up
"""

from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.game.strategy import TeamStrategy
from tlcomm_core.records import StrategyRecord, TaskRecord

__all__ = ["StrategyFinding", "audit_strategies"]

_SLACK_S = 1e-6

_Held = Mapping[str, Sequence[TeamStrategy]]


@dataclass(frozen=True, slots=True)
class StrategyFinding:
    """What is held.

    Attributes:
        rounds: how many rounds any agent holds a strategy for.
        equal: for how many of these all agents hold the same.
        violations: one line each.
    """

    rounds: int
    equal: int
    violations: tuple[str, ...]


def audit_strategies(
    strategies: Sequence[StrategyRecord],
    events: Sequence[TaskRecord],
    agents: Sequence[str],
    period_s: float,
) -> StrategyFinding:
    """Compare the strategies that agents hold.

    A round may be held by some agents only if the run ended before the meeting before it did.

    Args:
        strategies: all that were published.
        events: of all agents.
        agents: who should hold them.
        period_s: T_c.
    """
    held: dict[int, dict[str, list[TeamStrategy]]] = defaultdict(lambda: defaultdict(list))
    for record in strategies:
        held[record.strategy.round][record.agent].append(record.strategy)
    ended = _meetings_ended(events, agents)
    rounds = set(held) | {number + 1 for number in ended}
    violations: list[str] = []
    equal = 0
    for number in sorted(rounds):
        found = list(_faults(number, held[number], agents, complete=number - 1 in ended))
        found += _miscounted(number, held[number], agents, period_s)
        violations += found
        equal += not found and len(held[number]) == len(agents)
    return StrategyFinding(len(rounds), equal, tuple(violations))


def _meetings_ended(events: Sequence[TaskRecord], agents: Sequence[str]) -> set[int]:
    """Return the rounds whose meeting has ended for every agent."""
    ended: dict[int, set[str]] = defaultdict(set)
    for record in events:
        if record.event.kind is TaskEventKind.MEETING_ENDED:
            ended[record.event.round].add(record.agent)
    return {number for number, names in ended.items() if names >= set(agents)}


def _faults(number: int, held: _Held, agents: Sequence[str], *, complete: bool) -> Iterator[str]:
    for agent in agents:
        own = held.get(agent, ())
        if len(own) > 1:
            yield f"round {number}: {agent} holds {len(own)} strategies"
        if not own and complete:
            yield f"round {number}: {agent} holds no strategy"
    first = next((name for name in agents if held.get(name)), None)
    for agent in agents:
        if first is not None and held.get(agent) and held[agent][0] != held[first][0]:
            yield f"round {number}: {agent} holds another strategy than {first}"


def _miscounted(number: int, held: _Held, agents: Sequence[str], period_s: float) -> Iterator[str]:
    """Say whether t_c and Φ follow from the strategies, and one is there for every agent."""
    for strategy in {own for values in held.values() for own in values}:
        names = [own.agent for own in strategy.strategies]
        if names != sorted(agents):
            yield f"round {number}: strategies of {names}, not of each agent in order"
            continue
        arrivals_s = [own.arrival_s for own in strategy.strategies]
        starts_s = max(*arrivals_s, number * period_s)
        total_s = sum(own.extra_travel_s + starts_s - own.arrival_s for own in strategy.strategies)
        if abs(starts_s - strategy.communication_s) > _SLACK_S:
            yield f"round {number}: t_c is {strategy.communication_s:.6f} s, not {starts_s:.6f} s"
        if abs(total_s - strategy.potential_s) > _SLACK_S:
            yield f"round {number}: Φ is {strategy.potential_s:.6f} s, not {total_s:.6f} s"
