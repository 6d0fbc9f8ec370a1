"""What of a run figures are drawn from.

``trace_text``  its trace, as a file's text
"""

from collections.abc import Mapping
from typing import Any, Final

from tlcomm_core.errors import TlcommError
from tlcomm_core.game.solver import SOLVERS
from tlcomm_core.method import Method
from tlcomm_core.records import RunRecords
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_tools.comparison.job import Job
from tlcomm_tools.figures.courses import follow_courses
from tlcomm_tools.figures.elements import Course
from tlcomm_tools.figures.trace import Trace

__all__ = ["trace_text"]

_FOLLOWED: Final = 8


def trace_text(job: Job, scenario: Scenario, records: RunRecords, result: Mapping[str, Any]) -> str:
    """Return the trace of a run.

    Args:
        job: what was run.
        scenario: the same, read.
        records: what happened.
        result: its result document.
    """
    courses = _courses(job, scenario) if job.method is Method.TEAM else ()
    return Trace.from_records(scenario, job.method, records, result, courses).to_json()


def _courses(job: Job, scenario: Scenario) -> tuple[Course, ...]:
    """Return how the cost came down in the first rounds; nothing if they aren't all to be had."""
    rounds = min(_FOLLOWED, int(job.until_s / scenario.communication.period_s) - 1)
    if rounds < 1:
        return ()
    try:
        return follow_courses(Site.from_scenario(scenario), rounds, job.seed, SOLVERS[job.solver])
    except TlcommError:
        return ()
