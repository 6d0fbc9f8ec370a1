"""Whether the places that agents agree on are as the scenario demands.

``audit_meetings``  what is wrong with them
"""

import math
from collections.abc import Iterator, Sequence
from itertools import combinations

from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.records import StrategyRecord
from tlcomm_core.scenario.model import Scenario
from tlcomm_tools.audit.links import reaches_all

__all__ = ["audit_meetings"]

_SLACK_M = 1e-6
# Of two, neither keeps the other connected.
_LEAST_RESILIENT_TEAM = 3


def audit_meetings(scenario: Scenario, strategies: Sequence[StrategyRecord]) -> Iterator[str]:
    """Say which places of held strategies are too close, and whom a meeting hangs on alone."""
    demands = scenario.communication
    for held in dict.fromkeys(record.strategy for record in strategies):
        yield from _crowded(held, demands.separation_m)
        if demands.resilience and len(held.strategies) >= _LEAST_RESILIENT_TEAM:
            yield from _indispensable(held, demands.range_m)


def _crowded(held: TeamStrategy, separation_m: float) -> Iterator[str]:
    for one, other in combinations(held.strategies, 2):
        apart_m = _distance_m(one, other)
        if apart_m < separation_m - _SLACK_M:
            yield (
                f"round {held.round}: {one.agent} and {other.agent} meet {apart_m:.3f} m apart, "
                f"not {separation_m:g} m"
            )


def _indispensable(held: TeamStrategy, range_m: float) -> Iterator[str]:
    for lost in held.strategies:
        others = [own for own in held.strategies if own is not lost]
        neighbours = [
            sum(
                1 << index
                for index, other in enumerate(others)
                if other is not one and _distance_m(one, other) <= range_m + _SLACK_M
            )
            for one in others
        ]
        if not reaches_all(neighbours):
            yield f"round {held.round}: without {lost.agent} the others would be apart"


def _distance_m(one: Strategy, other: Strategy) -> float:
    return math.dist((one.x_m, one.y_m), (other.x_m, other.y_m))
