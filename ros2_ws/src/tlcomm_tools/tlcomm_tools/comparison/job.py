"""One run of a comparison: what it needs, what it leaves, and how it is done in one process.

``Job``       what is run
``Finished``  the files of a run
``Failed``    why there is no run
``execute``   runs it here
``TRACE``     name of the file that figures are drawn from
"""

import time
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from tlcomm_core.errors import TlcommError
from tlcomm_core.game.solver import SOLVERS
from tlcomm_core.method import Method
from tlcomm_core.mission import Mission
from tlcomm_core.result import RunFacts, result_document
from tlcomm_core.scenario.loader import loads
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate
from tlcomm_core.units import seconds
from tlcomm_tools.figures.trace import Trace
from tlcomm_tools.folder import dumps_json

__all__ = ["TRACE", "Failed", "Finished", "Job", "Outcome", "execute"]

TRACE: Final = "trace.json"

_PACE: Final = "lockstep"


@dataclass(frozen=True, slots=True)
class Job:
    """One run; all that it needs, so that it can be done on another machine.

    Attributes:
        folder: where its files belong, relative to the comparison's.
        scenario: text, perturbed and with every default filled in.
        method: of coordination.
        solver: name of the solver of the rounds, as far as the method leaves the choice.
        seed: of the repetition, and of all that is random.
        until_s: simulated time at its end.
        effort: about how long it takes, in no unit.
        value: of what is swept; ``None`` without a sweep.
        is_drawn: whether figures need more of it than its results.
    """

    folder: str
    scenario: str
    method: Method
    solver: str
    seed: int
    until_s: float
    effort: float
    value: float | None = None
    is_drawn: bool = False


@dataclass(frozen=True, slots=True)
class Finished:
    """What a run leaves.

    Attributes:
        files: texts by file name.
    """

    files: Mapping[str, str]


@dataclass(frozen=True, slots=True)
class Failed:
    """Why there is no run.

    Attributes:
        reason: one line.
    """

    reason: str


Outcome = Finished | Failed


def execute(job: Job) -> Outcome:
    """Run a job in this process and return its files' texts; nothing is written.

    Whatever a run may stumble over is its outcome; other errors are faults of the program.
    """
    try:
        return _simulated(job)
    except TlcommError as error:
        return Failed(" ".join(str(error).split("\n")))


def _simulated(job: Job) -> Finished:
    scenario = loads(job.scenario, job.folder)
    solver = job.method.solver(SOLVERS[job.solver])
    solver.check_team(len(scenario.agents))
    site = Site.from_scenario(scenario)
    begun_s = time.perf_counter()
    left = simulate(Mission(site, job.seed, None, job.until_s, solver, job.method))
    facts = RunFacts(
        method=job.method,
        solver=solver.name,
        seed=job.seed,
        pace=_PACE,
        sim_s=seconds(left.sim_ns),
        wall_s=time.perf_counter() - begun_s,
    )
    result = result_document(scenario, left.records, facts)
    files = {"scenario.yaml": job.scenario, "result.json": dumps_json(result)}
    if job.is_drawn:
        files[TRACE] = Trace.from_records(scenario, job.method, left.records, result).to_json()
    return Finished(files)
