"""A comparison's plan: which runs there are, and what they have in common.

``Design``   what is compared
``jobs_of``  its runs
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Final

from tlcomm_core.game.solver import EXACT, Solver
from tlcomm_core.method import Method
from tlcomm_core.scenario.loader import dumps
from tlcomm_core.scenario.model import Scenario
from tlcomm_tools.comparison.job import Job
from tlcomm_tools.comparison.perturbation import perturbed
from tlcomm_tools.comparison.sweep import Sweep, shown

__all__ = ["Design", "jobs_of"]

# Less than the margin that meetings keep from their windows' ends, unless a scenario has a smaller
# one, and far above the rounding of times.
_SPARE_S: Final = 0.0005

# What a run takes, in runs of `none`.
_EFFORT: Final = {
    Method.NONE: 1.0,
    Method.PAIRWISE: 1.5,
    Method.STATIC: 2.0,
    Method.ALL_TIME: 3.0,
    Method.TEAM: 4.0,
    Method.ORACLE: 5.0,
}


@dataclass(frozen=True, slots=True)
class Design:
    """What is compared.

    Attributes:
        scenario: as given.
        methods: side by side; ``None`` for all that the team's size lets.
        seeds: how many repetitions.
        rounds: each run is as long as that many windows and the first; or ``None``.
        until_s: each run ends at this simulated time; or ``None``.
        solver: of the team's rounds.
        sweep: what is varied, or ``None``.
        with_processes: whether each run is one of ROS processes.
    """

    scenario: Scenario
    methods: tuple[Method, ...] | None
    seeds: int
    rounds: int | None
    until_s: float | None
    solver: Solver
    sweep: Sweep | None
    with_processes: bool

    def end_s(self, scenario: Scenario) -> float:
        """Return when all runs of a scenario end: when D_c after the last window is nearly over.

        By then every meeting that began in it in time is over, whatever the method, and nobody has
        kept the next window yet: all are judged by equally many.
        """
        if self.until_s is not None:
            return self.until_s
        assert self.rounds is not None
        timing = scenario.communication
        return (self.rounds + 1) * timing.period_s + timing.duration_s - _SPARE_S

    def methods_of(self, scenario: Scenario) -> tuple[Method, ...]:
        """Return the methods that a scenario's team is compared by.

        Raises:
            InputError: the team is too large for one of those asked for.
        """
        if self.methods is not None:
            for method in self.methods:
                method.solver(self.solver).check_team(len(scenario.agents))
            return self.methods
        fits = EXACT.most_agents is None or len(scenario.agents) <= EXACT.most_agents
        return tuple(method for method in Method if fits or method is not Method.ORACLE)

    def points(self) -> Iterator[tuple[float | None, Scenario]]:
        """Yield each value of the sweep with its scenario; the scenario alone without a sweep.

        Raises:
            InputError: a value makes no scenario that can be run.
        """
        if self.sweep is None:
            yield None, self.scenario
            return
        for value in self.sweep.values:
            yield value, self.sweep.scenario(self.scenario, value)

    def terms(self) -> dict[str, Any]:
        """Return what runs must have in common to be compared, as a document.

        More methods, seeds and values may be added to runs of the same terms.
        """
        return {
            "scenario": dumps(self.scenario),
            "rounds": self.rounds,
            "until_s": self.until_s,
            "solver": self.solver.name,
            "sweep": None if self.sweep is None else self.sweep.name,
            "processes": self.with_processes,
        }


def jobs_of(design: Design) -> list[Job]:
    """Return a comparison's runs, by value of the sweep, method and seed.

    Raises:
        InputError: a value of the sweep makes no scenario that can be run, or a team is too large
            for a method.
        PlanningError: an agent starts where its task forbids it to be.
    """
    jobs: list[Job] = []
    for value, scenario in design.points():
        texts = [dumps(perturbed(scenario, seed)) for seed in range(design.seeds)]
        jobs += [
            _job(design, value, scenario, method, seed, text)
            for method in design.methods_of(scenario)
            for seed, text in enumerate(texts)
        ]
    return jobs


def _job(
    design: Design, value: float | None, scenario: Scenario, method: Method, seed: int, text: str
) -> Job:
    above = ""
    if design.sweep is not None and value is not None:
        above = f"{design.sweep.name}-{shown(value)}/"
    until_s = design.end_s(scenario)
    return Job(
        folder=f"{above}{method}-{seed}",
        scenario=text,
        method=method,
        solver=design.solver.name,
        seed=seed,
        until_s=until_s,
        effort=_EFFORT[method] * len(scenario.agents) ** 2 * until_s,
        value=value,
        is_drawn=value is None and seed == 0,
    )
