"""How long it is worth staying at a meeting."""

import math
from dataclasses import dataclass

import pytest

from support.meetings import make_team
from tlcomm_core.agent.meeting import Meeting, News
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.protocol.whereabouts import Ending

# T_c = 60 s and D_c = 5 s; the meeting of round 1 began at 100 s, and plans for [120 s, 180 s).
OVER_S, LATEST_S = 105.0, 125.0
WAY_S, NEXT_S = 20.0, 130.0
NEXT = TeamStrategy(
    round=2,
    iteration=0,
    strategies=tuple(
        Strategy(f"agent_{index:02d}", 1.0, float(index), 3, 128.0, 0.0) for index in range(2)
    ),
    communication_s=NEXT_S,
    potential_s=0.0,
    initial_potential_s=0.0,
)


@dataclass
class Told:
    """What a negotiation would say."""

    meeting_s: float | None = 100.0
    confirmed: TeamStrategy | None = None
    agreed: TeamStrategy | None = None
    is_settled: bool = False
    obstacle: str | None = None
    round: int = 2
    next_need_s: float = math.inf

    def proceed(self, now_s: float) -> tuple[()]:
        """Say nothing."""
        assert now_s >= 0.0
        return ()


def meeting_with(told: Told, way_s: float = WAY_S) -> Meeting:
    """Return a meeting at which that is known."""
    return Meeting(
        "agent_00", told, make_team(2), lambda strategy: strategy.communication_s - way_s
    )  # type: ignore[arg-type]


def leaves_s(told: Told, since_s: float = 101.0, way_s: float = WAY_S) -> float:
    """Return when an agent leaves that has known that much since a time."""
    meeting = meeting_with(told, way_s)
    meeting.proceed(since_s)
    meeting.news(max(since_s, OVER_S))
    time_s = meeting.next_change_s
    assert meeting.ending(math.nextafter(time_s - 1e-6, 0.0)) is None
    assert meeting.ending(time_s) is not None
    return time_s


def test_who_is_settled_leaves_when_the_meeting_is_over() -> None:
    """At t_c + D_c; if it got so far later, at once."""
    told = Told(confirmed=NEXT, agreed=NEXT, is_settled=True)
    assert leaves_s(told) == leaves_s(told, 109.0) == OVER_S
    meeting = meeting_with(told)
    meeting.proceed(109.0)
    assert meeting.ending(109.0) is Ending.AGREED
    assert meeting.is_prolonged


@pytest.mark.parametrize(
    ("since_s", "expected_s"), [(101.0, 105.5), (110.0, 110.5), (124.8, 125.0)]
)
def test_who_may_be_needed_lingers(since_s: float, expected_s: float) -> None:
    """For half a second after the meeting or its own agreement, while others may confirm."""
    told = Told(confirmed=NEXT, agreed=NEXT)
    assert leaves_s(told, since_s) == expected_s


@pytest.mark.parametrize(
    ("way_s", "expected_s"), [(20.0, 110.0), (2.0, 125.0), (29.0, 105.5), (24.0, 106.0)]
)
def test_who_is_in_doubt_leaves_to_be_there_in_time(way_s: float, expected_s: float) -> None:
    """As late as it can be at its place by the next t_c, but not after the last who may confirm,
    nor before having lingered.
    """
    told = Told(confirmed=NEXT)
    assert leaves_s(told, way_s=way_s) == expected_s
    meeting = meeting_with(told, way_s)
    meeting.proceed(101.0)
    assert meeting.ending(expected_s) is Ending.DOUBTFUL


@pytest.mark.parametrize(("meeting_s", "ending"), [(100.0, Ending.GATHERED), (None, Ending.MISSED)])
def test_who_has_not_confirmed_stays_until_that_is_too_late(
    meeting_s: float | None, ending: Ending
) -> None:
    """D_c into the next window; it knows whether all were here."""
    told = Told(meeting_s=meeting_s)
    assert leaves_s(told) == LATEST_S
    assert meeting_with(told).ending(LATEST_S) is ending


def test_a_meeting_that_begins_late_lasts_for_its_duration() -> None:
    """Even if confirming is too late before that."""
    assert leaves_s(Told(meeting_s=124.0, confirmed=NEXT, agreed=NEXT), 124.1) == 129.0


def test_it_asks_to_be_woken_for_what_is_next() -> None:
    """Its beginning, its end without agreement, leaving it; or what the negotiation needs."""
    told = Told(next_need_s=103.0)
    meeting = meeting_with(told)
    assert meeting.next_change_s == 100.0
    assert meeting.news(100.0) == (News.STARTED,)
    assert meeting.next_change_s == OVER_S
    assert meeting.next_need_s == 103.0
    assert meeting.news(OVER_S) == (News.OVERDUE,)
    assert meeting.next_change_s == LATEST_S


def test_news_is_told_once() -> None:
    """What happens at one instant in order; what is agreed in time isn't overdue."""
    told = Told(meeting_s=None, obstacle="agent_01 is busy")
    meeting = meeting_with(told)
    assert meeting.news(99.0) == (News.OBSTRUCTED,)
    told.meeting_s, told.agreed = 100.0, NEXT
    assert not meeting.is_agreed
    assert meeting.news(100.0) == (News.STARTED, News.AGREED)
    assert meeting.is_agreed
    assert meeting.news(OVER_S) == ()
