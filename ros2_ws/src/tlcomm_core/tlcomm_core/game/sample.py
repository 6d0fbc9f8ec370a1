"""Seeded random round problems, for tests and benchmarks of solvers.

``sample_problem``  a round of agents that shuttle between random places
"""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.links import Links
from tlcomm_core.game.problem import Candidates, RoundProblem

__all__ = ["sample_problem"]

# Share of entries made unreachable.
_UNREACHABLE: Final = 0.05


def sample_problem(
    rng: np.random.Generator, team_size: int, tasks: int, columns: int, rows: int
) -> RoundProblem:
    """Return a random round problem, most often a feasible one.

    Places form a lattice 0.5 m apart, driven along its axes at 1 m/s, so that many strategies are
    equally good. Some entries are unreachable at random.

    Args:
        rng: the only source of randomness.
        team_size: N ≥ 1.
        tasks: H ≥ 1, most candidates h of an agent.
        columns: places along x.
        rows: places along y.
    """
    x, y = np.meshgrid(np.arange(columns), np.arange(rows))
    locations_m = 0.5 * np.column_stack((x.ravel(), y.ravel())).astype(np.float64)
    opens_s = 60.0 * int(rng.integers(1, 100))
    return RoundProblem(
        round=round(opens_s / 60.0),
        window_s=(opens_s, opens_s + 60.0),
        links=Links(locations_m, float(rng.choice([0.5, 0.75, 1.0]))),
        candidates=tuple(
            _sample_candidates(rng, f"agent_{agent:02d}", tasks, locations_m, opens_s)
            for agent in range(team_size)
        ),
    )


def _sample_candidates(
    rng: np.random.Generator,
    agent: str,
    tasks: int,
    locations_m: NDArray[np.float64],
    opens_s: float,
) -> Candidates:
    # Steps h and h + 1 of the plan, and the times between all places and these.
    stops_m = rng.choice(locations_m, size=tasks + 1)
    time_s = np.abs(stops_m[:, None, :] - locations_m[None, :, :]).sum(axis=2)
    between_s = np.abs(np.diff(stops_m, axis=0)).sum(axis=1)
    actions_s = rng.integers(1, max(2, 120 // tasks), size=tasks)
    finish_s = opens_s - 30.0 + np.cumsum(actions_s + np.append(rng.uniform(), between_s[:-1]))
    arrival_s = finish_s[:, None] + time_s[:-1]
    extra_s = time_s[:-1] + time_s[1:] - between_s[:, None]
    admissible = (arrival_s < opens_s + 60.0) & (rng.uniform(size=arrival_s.shape) > _UNREACHABLE)
    kept = admissible.any(axis=1)
    return Candidates(
        agent=agent,
        task_index=int(rng.integers(0, 50)) + np.flatnonzero(kept).astype(np.int64),
        arrival_s=np.where(admissible, arrival_s, np.inf)[kept],
        extra_s=np.where(admissible, extra_s, np.inf)[kept],
    )
