"""Why a round's meeting is as it is, for people and as a document.

``format_explanation``    as text
``explanation_document``  as JSON-ready values
"""

from collections.abc import Sequence
from dataclasses import asdict

from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.game.rationale import Attendance, rationale
from tlcomm_core.game.solver import Solved
from tlcomm_core.game.strategy import Strategy
from tlcomm_tools.table import format_number, format_table

__all__ = ["explanation_document", "format_explanation"]

_NOTHING = 5e-4


def format_explanation(problem: RoundProblem, solved: Solved) -> str:
    """Return what each agent pays, its best alternative and its price, and the course of Φ."""
    attendances = rationale(problem, solved.solution.nash)
    rows = [_row(attendance) for attendance in attendances]
    header = ("agent", "pays/s", "detour", "wait", "else: z", "h", "costs/s")
    last = max(attendances, key=lambda own: own.strategy.arrival_s).strategy
    opens_s, _ = problem.window_s
    decider = f"{last.agent}, the last to arrive" if last.arrival_s > opens_s else "the window"
    return (
        f"{format_table(header, rows)}\n\n"
        f"  pays    ξ: detour and wait; together Φ\n"
        f"  else    its best other choice while the others stay, and what that costs the team\n"
        f"  t_c     is decided by {decider}\n\n"
        f"{_format_course(solved)}"
    )


def explanation_document(problem: RoundProblem, solved: Solved) -> dict[str, object]:
    """Return the same, ready for ``json.dumps``."""
    return {
        "agents": [asdict(attendance) for attendance in rationale(problem, solved.solution.nash)],
        "potentials": _course(solved),
    }


def _row(attendance: Attendance) -> Sequence[str]:
    own, other = attendance.strategy, attendance.alternative
    return (
        own.agent,
        format_number(attendance.additional_s, 2),
        format_number(_clean(own.extra_travel_s), 2),
        format_number(_clean(attendance.wait_s), 2),
        "–" if other is None else _place(other),
        "–" if other is None else str(other.task_index),
        format_number(attendance.increase_s, 2),
    )


def _place(strategy: Strategy) -> str:
    return f"({strategy.x_m:g}, {strategy.y_m:g})"


def _clean(time_s: float) -> float:
    """Return a time without the sign of rounding."""
    return 0.0 if abs(time_s) < _NOTHING else time_s


def _course(solved: Solved) -> list[float]:
    """Return Φ of S⁰ and after each step."""
    course_s = list(solved.solution.potentials_s)
    return course_s if solved.proposer is None else [solved.initial_potential_s, *course_s]


def _format_course(solved: Solved) -> str:
    course_s = _course(solved)
    steps = [f"Φ(S⁰) = {course_s[0]:.3f} s"]
    if solved.proposer is not None:
        steps.append(f"the best proposal {course_s[1]:.3f} s")
    moves_s = course_s[len(steps) :]
    if moves_s:
        steps.append("by single moves " + ", ".join(f"{value_s:.3f}" for value_s in moves_s) + " s")
    return "  " + "; ".join(steps) + "; nobody gains by moving alone"
