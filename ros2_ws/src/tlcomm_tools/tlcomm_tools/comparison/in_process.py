"""A comparison's job inside one process, without ROS.

``execute``  runs it
"""

from tlcomm_core.errors import TlcommError
from tlcomm_core.game.solver import SOLVERS
from tlcomm_core.mission import Mission
from tlcomm_core.scenario.loader import loads
from tlcomm_core.scenario.site import Site
from tlcomm_tools.audit.findings import audit_run
from tlcomm_tools.comparison.job import AUDIT, TRACE, Failed, Finished, Job, Outcome
from tlcomm_tools.comparison.tracing import trace_text
from tlcomm_tools.folder import dumps_json
from tlcomm_tools.timed_simulation import simulate_timed

__all__ = ["execute"]


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
    mission = Mission(site, job.seed, None, job.until_s, solver, job.method)
    left, result = simulate_timed(mission)
    audit = audit_run(scenario, job.method, left.records, left.sim_ns)
    files = {
        "scenario.yaml": job.scenario,
        "result.json": dumps_json(result),
        AUDIT: dumps_json(audit.document()),
    }
    if job.is_drawn:
        files[TRACE] = trace_text(job, scenario, left.records, result)
    return Finished(files)
