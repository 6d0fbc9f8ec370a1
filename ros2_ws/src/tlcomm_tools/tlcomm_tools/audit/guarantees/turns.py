"""The promise of leading by turns: one agent acts at a time, and each turn is the next agent's.

``take_turns``  whether that was so
"""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_tools.audit.evidence import Evidence
from tlcomm_tools.audit.guarantees.guarantee import Guarantee

__all__ = ["take_turns"]

_SLACK_S: Final = 1e-6


@dataclass(frozen=True, slots=True, order=True)
class _Step:
    """An action, from its start to its end or its failure, or a visit, which takes no time."""

    start_s: float
    agent: str
    stop_s: float
    turn: int


def take_turns(evidence: Evidence) -> Guarantee:
    """Say who acted while another did, or in a turn that was another's.

    Turns go round in the order of the agents' names. Not every turn needs to have a step.
    """
    steps = sorted(step for agent in evidence.agents for step in _steps(evidence, agent))
    turns = len({step.turn for step in steps})
    return Guarantee(
        promise="one agent acts at a time, by turns",
        shown={"turns": f"{turns} with {len(steps)} steps"},
        figures={"turns": turns, "steps": len(steps)},
        violations=(*_overlaps(steps), *_disorder(steps), *_usurped(steps, evidence.agents)),
    )


def _steps(evidence: Evidence, agent: str) -> Iterator[_Step]:
    started: tuple[float, int] | None = None
    for record in evidence.events_of(agent):
        event, time_s = record.event, record.stamp_ns * 1e-9
        if event.kind is TaskEventKind.ACTION_STARTED:
            started = time_s, event.round
        elif event.kind is TaskEventKind.REGION_VISITED:
            yield _Step(time_s, agent, time_s, event.round)
        elif started is not None and (
            event.is_failed_attempt or event.kind is TaskEventKind.ACTION_FINISHED
        ):
            yield _Step(started[0], agent, time_s, started[1])
            started = None
    if started is not None:
        yield _Step(started[0], agent, evidence.end_s, started[1])


def _overlaps(steps: Sequence[_Step]) -> Iterator[str]:
    """Say who acted while another did."""
    latest: _Step | None = None
    for step in steps:
        if latest is not None and step.start_s < latest.stop_s - _SLACK_S:
            yield f"{step.start_s:.3f} s: {step.agent} acts while {latest.agent} still does"
        if latest is None or step.stop_s > latest.stop_s:
            latest = step


def _disorder(steps: Sequence[_Step]) -> Iterator[str]:
    """Say which turns came after later ones."""
    for earlier, later in pairwise(steps):
        if later.turn < earlier.turn:
            yield f"{later.start_s:.3f} s: turn {later.turn} comes after turn {earlier.turn}"


def _usurped(steps: Sequence[_Step], agents: Sequence[str]) -> Iterator[str]:
    """Say who took another's turn; which is whose follows from most of the steps."""
    if not steps:
        return
    names = sorted(agents)
    shifts = [(names.index(step.agent) - step.turn) % len(names) for step in steps]
    usual = Counter(shifts).most_common(1)[0][0]
    for step, shift in zip(steps, shifts, strict=True):
        if shift != usual:
            owner = names[(step.turn + usual) % len(names)]
            yield f"{step.start_s:.3f} s: {step.agent} acts in turn {step.turn}, {owner}'s"
