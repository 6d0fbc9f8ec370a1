"""A comparison's jobs as teams of ROS processes, one after the other.

``process_outcomes``  jobs done, as they come
"""

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path

from tlcomm_core.errors import TlcommError
from tlcomm_core.game.solver import SOLVERS
from tlcomm_core.pace import Pace
from tlcomm_core.scenario.loader import loads
from tlcomm_tools.audit.findings import audit_run
from tlcomm_tools.bag.reader import read_run
from tlcomm_tools.comparison.archive import Archive
from tlcomm_tools.comparison.job import AUDIT, TRACE, Failed, Job
from tlcomm_tools.comparison.tracing import trace_text
from tlcomm_tools.folder import dumps_json, replace_file
from tlcomm_tools.run import RunOptions, run_mission
from tlcomm_tools.status import Status

__all__ = ["process_outcomes"]


def process_outcomes(
    archive: Archive, jobs: Sequence[Job], on_wait: Callable[[], None]
) -> Iterator[tuple[Job, Failed | None]]:
    """Yield jobs as they are done, with why there is no run if so; else its files are in place.

    Args:
        archive: where the runs go, bags and logs included.
        jobs: in the order in which they are run.
        on_wait: called now and then in between.

    Raises:
        KeyboardInterrupt: the run under way was interrupted.
    """
    for job in jobs:
        failed = _run(job, archive.staging(job), on_wait)
        if failed is None:
            archive.adopt(job)
        yield job, failed


def _run(job: Job, out: Path, on_wait: Callable[[], None]) -> Failed | None:
    scenario = loads(job.scenario, job.folder)
    solver = job.method.solver(SOLVERS[job.solver])
    options = RunOptions(scenario, job.method, solver, job.seed, Pace(None), None, job.until_s, out)
    try:
        report = run_mission(options, lambda _sim_s, _meetings: on_wait())
    except TlcommError as error:
        return Failed(" ".join(str(error).split("\n")))
    if report.status is Status.INTERRUPTED:
        raise KeyboardInterrupt
    if report.failure is not None:
        failure = report.failure
        return Failed(f"{failure.name}: {failure.reason} (logs: {report.folder.logs})")
    recorded = read_run(report.folder.bag)
    audit = audit_run(
        scenario, job.method, recorded.records, recorded.end_ns, recorded.damage, recorded.pace
    )
    replace_file(out / AUDIT, dumps_json(audit.document()))
    if job.is_drawn:
        replace_file(out / TRACE, trace_text(job, scenario, recorded.records, report.result))
    return None
