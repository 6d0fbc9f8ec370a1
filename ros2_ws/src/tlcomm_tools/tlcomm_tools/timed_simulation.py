"""A mission inside this process, with the time that it took.

``simulate_timed``  runs it; what it leaves, and its results
"""

import time
from collections.abc import Callable
from typing import Any

from tlcomm_core.mission import Mission
from tlcomm_core.pace import LOCK_STEP
from tlcomm_core.result import RunFacts, result_document
from tlcomm_core.simulation import Simulated, simulate
from tlcomm_core.units import seconds

__all__ = ["simulate_timed"]


def simulate_timed(
    mission: Mission, on_progress: Callable[[int, int], None] | None = None
) -> tuple[Simulated, dict[str, Any]]:
    """Run a mission in this process; return what it leaves, and its results for ``json.dumps``.

    Args:
        mission: what to run.
        on_progress: as ``simulate`` calls it.

    Raises:
        PlanningError: an agent's task has no plan.
        InfeasibleRoundError: the team has no admissible next meeting.
    """
    begun_s = time.perf_counter()
    left = simulate(mission, on_progress)
    facts = RunFacts(
        method=mission.method,
        solver=mission.solver.name,
        seed=mission.seed,
        pace=str(LOCK_STEP),
        sim_s=seconds(left.sim_ns),
        wall_s=time.perf_counter() - begun_s,
    )
    return left, result_document(mission.site.scenario, left.records, facts)
