"""Each task's progress, recomputed from what was done and where.

``TaskFinding``  one agent's outcome
``audit_task``   recomputes it
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import NamedTuple

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.method import Method
from tlcomm_core.records import TaskRecord
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.scenario.task import task_of
from tlcomm_tools.audit.evidence import Evidence
from tlcomm_tools.audit.formula import Tree, count_fulfilled, read_formula, recurring_part
from tlcomm_tools.audit.progress import Progress, follow
from tlcomm_tools.audit.tracks import Track
from tlcomm_tools.audit.words import Letter, read_word

__all__ = ["TaskFinding", "audit_task"]

_TIME_SLACK_S = 1e-6
_SPARE_WINDOWS = 2
_STEPS = (TaskEventKind.ACTION_FINISHED, TaskEventKind.REGION_VISITED)


@dataclass(frozen=True, slots=True)
class TaskFinding:
    """One agent's outcome.

    Attributes:
        agent: whose.
        claimed: how often it said that its task was satisfied.
        satisfied: how often it was; for other tasks than □◇φ with co-safe φ, how often a step
            took an accepting transition, or ``None`` where the steps leave that open.
        longest_gap_s: the longest time without a satisfaction, or ``None`` for those others.
        verdict: one of ``progress.WORDS``, or ``None`` where the steps leave that open.
        settled_s: when it became *fulfilled* or *violated*, else ``None``.
        violations: one line each.
    """

    agent: str
    claimed: int
    satisfied: int | None
    longest_gap_s: float | None
    verdict: str | None
    settled_s: float | None
    violations: tuple[str, ...]


def audit_task(method: Method, evidence: Evidence, agent: str) -> TaskFinding:
    """Recompute one agent's progress: its task's verdict and satisfactions.

    Args:
        method: of coordination, by which a task may take its time.
        evidence: what was asked for, and what was done.
        agent: whose task.
    """
    scenario, events, end_s = evidence.scenario, evidence.events_of(agent), evidence.end_s
    track = evidence.track_of.get(agent)
    claimed_s = _times_s(events, TaskEventKind.TASK_SATISFIED)
    if any(record.event.kind is TaskEventKind.TASK_CHANGED for record in events):
        # What the scenario says isn't what it did.
        return TaskFinding(agent, len(claimed_s), None, None, None, None, ())
    # A plan that begins anew claims what its own steps satisfy, not what all steps do.
    anew_s = min(_times_s(events, TaskEventKind.PLAN_CHANGED), default=math.inf)
    course = _course(scenario, agent, events, track)
    gap = course.longest_gap(end_s)
    settled, satisfied_s = course.progress.settled, course.satisfied_s
    return TaskFinding(
        agent=agent,
        claimed=len(claimed_s),
        satisfied=None if satisfied_s is None else len(satisfied_s),
        longest_gap_s=None if gap is None else gap.length_s,
        verdict=course.progress.verdict,
        settled_s=None if settled is None else course.times_s[settled],
        violations=(
            *_violated(agent, course),
            *_unfounded(agent, claimed_s, satisfied_s, anew_s),
            *_neglected(method, evidence, agent, course.recurring, gap),
        ),
    )


def _times_s(events: Sequence[TaskRecord], *kinds: TaskEventKind) -> list[float]:
    return [record.stamp_ns * 1e-9 for record in events if record.event.kind in kinds]


class _Gap(NamedTuple):
    """A time without a satisfaction."""

    length_s: float
    from_s: float


@dataclass(frozen=True, slots=True)
class _Course:
    """How a task went by the agent's steps.

    Attributes:
        word: what they read.
        times_s: of each prefix of the word, from the empty one on.
        progress: the task's.
        recurring: φ if the task is □◇φ with co-safe φ.
        satisfied_s: when it was satisfied; ``None`` where the steps leave that open.
    """

    word: Sequence[Letter]
    times_s: Sequence[float]
    progress: Progress
    recurring: Tree | None
    satisfied_s: Sequence[float] | None

    def longest_gap(self, end_s: float) -> _Gap | None:
        """Return the longest time without a satisfaction, the last of equals, of □◇φ alone."""
        if self.recurring is None or self.satisfied_s is None:
            return None
        moments_s = pairwise([0.0, *self.satisfied_s, end_s])
        return max(_Gap(later - earlier, earlier) for earlier, later in moments_s)


def _course(
    scenario: Scenario, agent: str, events: Sequence[TaskRecord], track: Track | None
) -> _Course:
    """Follow an agent's task along its steps."""
    own = scenario.agents[agent]
    steps = [record for record in events if record.event.kind in _STEPS]
    word = read_word(scenario, agent, steps, track)
    # What holds before the first letter, or where the agent started, needs no step.
    times_s = [0.0, 0.0, *_times_s(events, *_STEPS)]
    progress = follow(task_of(own), word)
    recurring = None if own.automaton is not None else recurring_part(read_formula(own.whole_task))
    ends = progress.passes if recurring is None else count_fulfilled(recurring, word)
    # A step claims what it does; the start claims nothing.
    satisfied_s = None if ends is None else [times_s[end + 1] for end in ends if end]
    return _Course(word, times_s, progress, recurring, satisfied_s)


def _violated(agent: str, course: _Course) -> Iterator[str]:
    """Say when the task became impossible to satisfy, and with what."""
    violated = course.progress.violated
    if violated is None:
        return
    what = "nothing satisfies it"
    if violated:
        letter = ", ".join(sorted(course.word[violated - 1]))
        what = f"what was true then: {{{letter}}}"
    yield f"{agent}: task violated at {course.times_s[violated]:.3f} s; {what}"


def _unfounded(
    agent: str, claimed_s: Sequence[float], satisfied_s: Sequence[float] | None, until_s: float
) -> Iterator[str]:
    """Say where claimed and recomputed satisfactions part up to a time, if those are known."""
    if satisfied_s is None:
        return
    claimed_s, satisfied_s = (
        [time_s for time_s in times_s if time_s <= until_s] for times_s in (claimed_s, satisfied_s)
    )
    for claim_s, truth_s in zip(claimed_s, satisfied_s, strict=False):
        if abs(claim_s - truth_s) > _TIME_SLACK_S:
            yield (
                f"{agent}: task claimed satisfied at {claim_s:.3f} s, by its steps it was "
                f"at {truth_s:.3f} s"
            )
            return
    if len(claimed_s) != len(satisfied_s):
        yield (
            f"{agent}: task claimed satisfied {len(claimed_s)} times, by its steps it was "
            f"{len(satisfied_s)} times"
        )


def _neglected(
    method: Method, evidence: Evidence, agent: str, recurring: Tree | None, gap: _Gap | None
) -> Iterator[str]:
    """Say when a recurring task went without satisfaction for longer than it may."""
    if recurring is None or gap is None:
        return
    until_s = gap.from_s + gap.length_s
    # Each attempt that failed may have cost a window.
    failed = sum(
        record.event.is_failed_attempt and gap.from_s < record.stamp_ns * 1e-9 <= until_s
        for record in evidence.events_of(agent)
    )
    actions = _action_count(recurring, evidence.scenario, agent)
    # Where agents lead by turns, each has only its share of the time.
    leaders = len(evidence.agents) if method is Method.ALL_TIME else 1
    windows = leaders * (actions + _SPARE_WINDOWS) + failed
    if gap.length_s > windows * evidence.scenario.communication.period_s:
        yield f"{agent}: task not satisfied from {gap.from_s:.3f} s to {until_s:.3f} s"


def _action_count(tree: Tree, scenario: Scenario, agent: str) -> int:
    operator, *operands = tree
    if operator == "atom":
        return int(operands[0] in scenario.actions_of(agent))
    return sum(_action_count(operand, scenario, agent) for operand in operands)
