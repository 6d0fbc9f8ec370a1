"""How well and how quickly solvers solve rounds.

``SolverRow``        a solver's figures on some instances
``measure_solvers``  all rows
``growth``           how a solver's time grows with the team
"""

import statistics
import time
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from tlcomm_core.game.algorithm import improve
from tlcomm_core.game.initial import initial_profile
from tlcomm_core.game.potential import potential
from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.game.solver import BEST_RESPONSE, EXACT, Solver
from tlcomm_tools.instances import Instances

__all__ = ["SEARCHERS", "SolverRow", "growth", "measure_solvers"]

SEARCHERS: Final = 8
"""Of a larger team, only as many agents search: it would find no less."""


@dataclass(frozen=True, slots=True)
class SolverRow:
    """A solver's figures on some instances.

    Attributes:
        solver: its name.
        instances: their name.
        agents: N.
        count: how many instances.
        agent_s: median processor time from the candidates to one agent's proposal; for best
            responses, to the equilibrium, all agents in one place.
        reference: what potentials are compared with: the solver that is the best there.
        mean_ratio: Φ over the reference's, in the mean.
        worst_ratio: the same, at worst.
    """

    solver: str
    instances: str
    agents: int
    count: int
    agent_s: float
    reference: str
    mean_ratio: float
    worst_ratio: float


@dataclass(frozen=True, slots=True)
class _Outcome:
    """What a team finds in one round, and the processor times that its agents take."""

    potential_s: float
    times_s: tuple[float, ...]


def measure_solvers(
    instances: Iterable[Instances], solvers: Sequence[Solver], searchers: int = SEARCHERS
) -> Iterator[SolverRow]:
    """Yield a row for each solver on each kind of instances that it is meant for.

    Potentials are compared with the optimum where ``EXACT`` is among the solvers and meant for the
    team, otherwise with best responses.

    Args:
        instances: what to solve.
        solvers: with what; ``BEST_RESPONSE`` is measured anyway.
        searchers: most agents that search in turn, spread over the team.
    """
    measured = (BEST_RESPONSE, *(solver for solver in solvers if solver is not BEST_RESPONSE))
    for own in instances:
        fitting = [
            solver for solver in measured if own.agents <= (solver.most_agents or own.agents)
        ]
        reference = EXACT if EXACT in fitting else BEST_RESPONSE
        outcomes: dict[str, list[_Outcome]] = {solver.name: [] for solver in fitting}
        for index in range(own.count):
            problem = own.problem(index)
            for solver in fitting:
                outcomes[solver.name].append(_solve(problem, solver, searchers))
        for solver in fitting:
            yield _row(own, solver.name, reference.name, outcomes)


def growth(rows: Iterable[SolverRow], solver: str) -> float | None:
    """Return the exponent p of a solver's time ~ N^p; ``None`` without two sizes.

    Args:
        rows: measured.
        solver: its name.
    """
    own = [row for row in rows if row.solver == solver]
    if len({row.agents for row in own}) < 2:  # noqa: PLR2004 (a line has two points)
        return None
    slope, _ = np.polyfit(
        np.log([row.agents for row in own]), np.log([row.agent_s for row in own]), 1
    )
    return float(slope)


def _solve(problem: RoundProblem, solver: Solver, searchers: int) -> _Outcome:
    team = len(problem.agents)
    # A map's links are looked up once and for all rounds.
    assert len(problem.links.neighbourhood_apart(problem.rules.separation_m))
    opens_s, _ = problem.window_s
    potentials_s: list[float] = []
    times_s: list[float] = []
    searching = range(0, team, max(1, team // searchers))[:searchers]
    for searcher in searching if solver.propose is not None else (0,):
        begun_s = time.process_time()
        profile = initial_profile(problem)
        if solver.propose is None:
            profile = improve(problem, profile).nash
        else:
            profile = solver.propose(problem, profile, searcher).profile
        times_s.append(time.process_time() - begun_s)
        potentials_s.append(potential(problem.strategies(profile), opens_s))
    return _Outcome(min(potentials_s), tuple(times_s))


def _row(
    own: Instances, solver: str, reference: str, outcomes: Mapping[str, Sequence[_Outcome]]
) -> SolverRow:
    ratios = [
        found.potential_s / best.potential_s
        for found, best in zip(outcomes[solver], outcomes[reference], strict=True)
    ]
    return SolverRow(
        solver=solver,
        instances=own.name,
        agents=own.agents,
        count=own.count,
        agent_s=statistics.median(
            time_s for outcome in outcomes[solver] for time_s in outcome.times_s
        ),
        reference=reference,
        mean_ratio=statistics.fmean(ratios),
        worst_ratio=max(ratios),
    )
