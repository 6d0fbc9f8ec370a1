"""The promise of a static topology: everybody meets where it started.

``keep_places``  whether that was agreed on
"""

import math
from collections.abc import Iterator

from tlcomm_core.game.strategy import TeamStrategy
from tlcomm_core.scenario.model import Scenario
from tlcomm_tools.audit.evidence import Evidence
from tlcomm_tools.audit.guarantees.guarantee import Guarantee
from tlcomm_tools.audit.words import cell_centre_m

__all__ = ["keep_places"]

_SLACK_M = 1e-6


def keep_places(evidence: Evidence) -> Guarantee:
    """Say who was to meet elsewhere than in the middle of the cell that it started in.

    Whether it was there, the windows tell.
    """
    held = list(dict.fromkeys(record.strategy for record in evidence.records.strategies))
    moved = [list(_moved(evidence.scenario, own)) for own in held]
    kept = moved.count([])
    return Guarantee(
        promise="every agent meets where it started",
        shown={"places kept": f"{kept} of {len(held)} strategies"},
        figures={"strategies": len(held), "strategies_in_place": kept},
        violations=tuple(line for lines in moved for line in lines),
    )


def _moved(scenario: Scenario, held: TeamStrategy) -> Iterator[str]:
    for own in held.strategies:
        start = scenario.agents.get(own.agent)
        if start is None:
            continue
        home_m = cell_centre_m(scenario.workspace, start.start[0], start.start[1])
        away_m = math.dist(home_m, (own.x_m, own.y_m))
        if away_m > _SLACK_M:
            yield f"round {held.round}: {own.agent} meets {away_m:.3f} m from where it started"
