"""Each task's progress, recomputed from what was done and where.

``TaskFinding``  one agent's outcome
``audit_task``   recomputes it
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.records import TaskRecord
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.scenario.task import task_of
from tlcomm_tools.audit.formula import Tree, count_fulfilled, read_formula, recurring_part
from tlcomm_tools.audit.progress import Progress, follow
from tlcomm_tools.audit.tracks import Track
from tlcomm_tools.audit.words import Letter, read_word

__all__ = ["TaskFinding", "audit_task"]

# An agent stands at a cell's centre to within its position tolerance; floating point beyond that.
_PLACE_SLACK_M = 1e-6
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


def audit_task(
    scenario: Scenario,
    agent: str,
    events: Sequence[TaskRecord],
    track: Track | None,
    end_s: float,
) -> TaskFinding:
    """Recompute one agent's progress: its task's verdict and satisfactions.

    Args:
        scenario: tasks, regions and durations.
        agent: whose.
        events: the agent's own, in order of time.
        track: where it was.
        end_s: end of the run.
    """
    steps = [record for record in events if record.event.kind in _STEPS]
    claimed_s = [
        record.stamp_ns * 1e-9
        for record in events
        if record.event.kind is TaskEventKind.TASK_SATISFIED
    ]
    if any(record.event.kind is TaskEventKind.TASK_CHANGED for record in events):
        # What the scenario says isn't what it did.
        seen = (*_misplaced(scenario, agent, events, track), *_hasty(scenario, agent, events))
        return TaskFinding(agent, len(claimed_s), None, None, None, None, seen)
    own = scenario.agents[agent]
    word = read_word(scenario, agent, steps, track)
    # What holds before the first letter, or where the agent started, needs no step.
    times_s = [0.0, 0.0, *(record.stamp_ns * 1e-9 for record in steps)]
    progress = follow(task_of(own), word)
    part = None
    if own.automaton is None:
        part = recurring_part(read_formula(own.whole_task))
    ends = progress.passes if part is None else count_fulfilled(part, word)
    # A step claims what it does; the start claims nothing.
    satisfied_s = None if ends is None else [times_s[end + 1] for end in ends if end]
    violations = [
        *_misplaced(scenario, agent, events, track),
        *_hasty(scenario, agent, events),
        *_violated(agent, progress, word, times_s),
    ]
    if satisfied_s is not None:
        violations += _unfounded(agent, claimed_s, satisfied_s)
    gap_s = None
    if part is not None and satisfied_s is not None:
        gap_s, gap_from_s = _longest_gap([0.0, *satisfied_s, end_s])
        # Each attempt that failed may have cost a window.
        failed = sum(
            record.event.is_failed_attempt
            and gap_from_s < record.stamp_ns * 1e-9 <= gap_from_s + gap_s
            for record in events
        )
        spare_s = failed * scenario.communication.period_s
        if gap_s > _patience_s(part, scenario, agent) + spare_s:
            violations.append(
                f"{agent}: task not satisfied from {gap_from_s:.3f} s to {gap_from_s + gap_s:.3f} s"
            )
    return TaskFinding(
        agent=agent,
        claimed=len(claimed_s),
        satisfied=None if satisfied_s is None else len(satisfied_s),
        longest_gap_s=gap_s,
        verdict=progress.verdict,
        settled_s=None if progress.settled is None else times_s[progress.settled],
        violations=tuple(violations),
    )


def _violated(
    agent: str, progress: Progress, word: Sequence[Letter], times_s: Sequence[float]
) -> Iterator[str]:
    """Say when the task became impossible to satisfy, and with what."""
    if progress.violated is None:
        return
    what = "nothing satisfies it"
    if progress.violated:
        letter = ", ".join(sorted(word[progress.violated - 1]))
        what = f"what was true then: {{{letter}}}"
    yield f"{agent}: task violated at {times_s[progress.violated]:.3f} s; {what}"


def _misplaced(
    scenario: Scenario, agent: str, events: Sequence[TaskRecord], track: Track | None
) -> Iterator[str]:
    """Say which actions were not done in the regions that they claim."""
    slack_m = scenario.drive_of(agent).position_tolerance_m + _PLACE_SLACK_M
    kinds = (TaskEventKind.ACTION_STARTED, *_STEPS)
    for record in events:
        event = record.event
        if track is None or event.kind not in kinds or not event.region:
            continue
        time_s = record.stamp_ns * 1e-9
        region = scenario.workspace.regions.get(event.region)
        if region is None:
            yield f"{agent}: {time_s:.3f} s: no region {event.region!r}"
            continue
        x_m, y_m = track.at(np.array([time_s]))[0]
        away_m = math.dist(region.at_m, (x_m, y_m))
        if away_m > region.radius_m + slack_m:
            yield (
                f"{agent}: {time_s:.3f} s: {event.action or 'visit'!r} done {away_m:.3f} m "
                f"from {event.region!r}, whose radius is {region.radius_m:g} m"
            )


def _hasty(scenario: Scenario, agent: str, events: Sequence[TaskRecord]) -> Iterator[str]:
    """Say which actions took less time than they take, or were finished without a start."""
    durations_s = scenario.actions_of(agent)
    started_s: dict[str, float] = {}
    for record in events:
        event, time_s = record.event, record.stamp_ns * 1e-9
        if event.kind is TaskEventKind.ACTION_STARTED:
            started_s[event.action] = time_s
        elif event.kind is TaskEventKind.ACTION_FINISHED and event.action:
            since_s = started_s.pop(event.action, None)
            if since_s is None:
                yield f"{agent}: {time_s:.3f} s: {event.action!r} finished, but never started"
            elif time_s - since_s < durations_s.get(event.action, 0.0) - _TIME_SLACK_S:
                yield (
                    f"{agent}: {time_s:.3f} s: {event.action!r} took {time_s - since_s:.3f} s, "
                    f"not {durations_s[event.action]:g} s"
                )


def _unfounded(
    agent: str, claimed_s: Sequence[float], satisfied_s: Sequence[float]
) -> Iterator[str]:
    """Say where claimed and recomputed satisfactions part."""
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


def _longest_gap(moments_s: Sequence[float]) -> tuple[float, float]:
    """Return the longest time between neighbours, and when it began."""
    return max((later - earlier, earlier) for earlier, later in pairwise(moments_s))


def _patience_s(part: Tree, scenario: Scenario, agent: str) -> float:
    """Return the longest that φ of □◇φ may go without being fulfilled."""
    return (_action_count(part, scenario, agent) + _SPARE_WINDOWS) * scenario.communication.period_s


def _action_count(tree: Tree, scenario: Scenario, agent: str) -> int:
    operator, *operands = tree
    if operator == "atom":
        return int(operands[0] in scenario.actions_of(agent))
    return sum(_action_count(operand, scenario, agent) for operand in operands)
