"""What was agreed on, and what came of it.

``round_documents``  all agreements of a run
"""

from collections import defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any, Final

from tlcomm_core.method import Method
from tlcomm_core.metrics.meeting import Meeting, meetings
from tlcomm_core.protocol.messages import BestResponse
from tlcomm_core.records import RunRecords, StrategyRecord
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.units import seconds
from tlcomm_tools.report.moves import Course, courses

__all__ = ["round_documents"]

_DIGITS: Final = 3

# A round, and who is to meet in it.
_Key = tuple[int, tuple[str, ...]]


def round_documents(
    scenario: Scenario,
    method: Method,
    records: RunRecords,
    end_s: float,
    said: Iterable[BestResponse] = (),
) -> list[dict[str, Any]]:
    """Return every agreement, by round and members: why it was made, and what it cost.

    Of methods without meetings, it is turns that are agreed on: of these there is only the plan.

    Args:
        scenario: what was run.
        method: of coordination.
        records: what happened.
        end_s: when the run ended.
        said: what agents told of their best responses.
    """
    agreed_s = _agreed_s(records.strategies)
    course_of = courses(said)
    period_s = scenario.communication.period_s
    agreed = meetings(scenario, records)
    if not method.has_meetings:
        agreed = tuple(replace(own, arrivals_s={}) for own in agreed)
    return [
        {
            **_round(own, period_s, agreed_s[own.round, own.members], end_s),
            "moves": course_of.get(own.round, Course()).moves_to(own.strategy),
        }
        for own in agreed
    ]


def _agreed_s(strategies: Iterable[StrategyRecord]) -> Mapping[_Key, dict[str, float]]:
    """Return when each agent first held each agreement."""
    held: defaultdict[_Key, dict[str, float]] = defaultdict(dict)
    for own in strategies:
        key = own.strategy.round, own.strategy.members
        held[key].setdefault(own.agent, _rounded(seconds(own.stamp_ns)))
    return held


def _round(
    meeting: Meeting, period_s: float, agreed_s: Mapping[str, float], end_s: float
) -> dict[str, Any]:
    strategy = meeting.strategy
    started = meeting.took_place_by(end_s)
    return {
        "round": meeting.round,
        "window_s": (meeting.opens_s, meeting.opens_s + period_s),
        "agreed_s": max(agreed_s.values()),
        "held_by": sorted(agreed_s),
        "planned_s": _rounded(strategy.communication_s),
        "started_s": _rounded(meeting.starts_s) if started and meeting.starts_s else None,
        "initial_potential_s": _rounded(strategy.initial_potential_s),
        "potential_s": _rounded(strategy.potential_s),
        "bound_s": None if strategy.bound_s is None else _rounded(strategy.bound_s),
        "move_count": strategy.iteration,
        "members": [_member(meeting, name) for name in meeting.members],
    }


def _member(meeting: Meeting, name: str) -> dict[str, Any]:
    own = meeting.strategy.part_of(name)
    return {
        "agent": name,
        "place_m": (_rounded(own.x_m), _rounded(own.y_m)),
        "after_step": own.task_index,
        "planned_arrival_s": _rounded(own.arrival_s),
        "planned_wait_s": _rounded(meeting.strategy.communication_s - own.arrival_s),
        "detour_s": _rounded(own.extra_travel_s),
        "arrival_s": _known(meeting.arrivals_s.get(name)),
        "wait_s": _known(meeting.wait_s.get(name)),
        "additional_s": _known(meeting.additional_s.get(name)),
    }


def _known(value_s: float | None) -> float | None:
    return None if value_s is None else _rounded(value_s)


def _rounded(value: float) -> float:
    return round(value, _DIGITS)
