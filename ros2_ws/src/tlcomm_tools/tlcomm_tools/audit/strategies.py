"""Whether those who agree on a strategy hold the same one, and one each.

``StrategyFinding``   what is held
``audit_strategies``  looks it up

Who agrees, and on what, depends on the method: ``agreements`` says it.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from tlcomm_core.method import Method
from tlcomm_tools.audit.agreements import Agreement, agreements_of
from tlcomm_tools.audit.evidence import Evidence

__all__ = ["StrategyFinding", "audit_strategies"]

_SLACK_S: Final = 1e-6


@dataclass(frozen=True, slots=True)
class StrategyFinding:
    """What is held.

    Attributes:
        rounds: how many rounds, meetings of pairs or turns any agent holds a strategy for.
        equal: for how many of these all who agree on it hold the same.
        violations: one line each.
    """

    rounds: int
    equal: int
    violations: tuple[str, ...]


def audit_strategies(method: Method, evidence: Evidence) -> StrategyFinding:
    """Compare the strategies that agents hold."""
    violations: list[str] = []
    rounds = equal = 0
    for agreement in agreements_of(method, evidence):
        found = [*_faults(agreement), *_miscounted(agreement)]
        violations += found
        rounds += 1
        equal += not found and len(agreement.held) == len(agreement.agents)
    return StrategyFinding(rounds, equal, tuple(violations))


def _faults(agreement: Agreement) -> Iterator[str]:
    """Say who holds none, several, or another strategy than the first."""
    name, held = agreement.name, agreement.held
    for agent in agreement.agents:
        own = held.get(agent, ())
        if len(own) > 1:
            yield f"{name}: {agent} holds {len(own)} strategies"
        if not own and agent in agreement.owing:
            yield f"{name}: {agent} holds no strategy"
    first = next((agent for agent in agreement.agents if agent in held), None)
    for agent in agreement.agents:
        if first is not None and agent in held and held[agent][0] != held[first][0]:
            yield f"{name}: {agent} holds another strategy than {first}"
    for agent in sorted(held.keys() - set(agreement.agents)):
        yield f"{name}: {agent} holds a strategy, but isn't one of them"


def _miscounted(agreement: Agreement) -> Iterator[str]:
    """Say whether t_c and Φ follow from the strategies, and one is there for every agent."""
    name = agreement.name
    for strategy in dict.fromkeys(own for values in agreement.held.values() for own in values):
        names = [own.agent for own in strategy.strategies]
        if names != sorted(agreement.agents):
            yield f"{name}: strategies of {names}, not of each agent in order"
            continue
        starts_s = max((agreement.opens_s, *(own.arrival_s for own in strategy.strategies)))
        total_s = sum(own.extra_travel_s + starts_s - own.arrival_s for own in strategy.strategies)
        if abs(starts_s - strategy.communication_s) > _SLACK_S:
            yield f"{name}: t_c is {strategy.communication_s:.6f} s, not {starts_s:.6f} s"
        if abs(total_s - strategy.potential_s) > _SLACK_S:
            yield f"{name}: Φ is {strategy.potential_s:.6f} s, not {total_s:.6f} s"
