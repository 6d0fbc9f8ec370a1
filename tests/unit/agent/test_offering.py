"""What agents lay open at a meeting."""

from dataclasses import replace

import pytest

from support.hall import DURATION_S, PERIOD_S, LoneAgent
from tlcomm_core.agent.diary import Prospect
from tlcomm_core.agent.itinerary import Itinerary
from tlcomm_core.agent.offering import Presence, later_offer, offer_of
from tlcomm_core.geometry import Pose

HERE, THERE = Pose(2.75, 0.75, 0.0), Pose(4.25, 1.25, 0.3)
PRESENCE = Presence(HERE, 0, 1.0, 4.0)


def agent() -> tuple[LoneAgent, Itinerary]:
    """Return an agent of the hall, and its itinerary."""
    own = LoneAgent("one", 1)
    return own, own.brain._itinerary


def test_who_has_nothing_else_ahead_offers_as_at_any_meeting() -> None:
    """The same stops, if the time until the window's end is the same."""
    own, itinerary = agent()
    settings = own.brain._settings
    now = Prospect(HERE, -1, PRESENCE.departure_s)
    later = later_offer(settings, itinerary, PRESENCE, now, 2 * PERIOD_S)
    assert later == offer_of(settings, itinerary, HERE, 0, 0, 1.0)


def test_stops_come_after_all_that_is_ahead() -> None:
    """The next step after those agreed, from where the last meeting is, timed from now on."""
    own, itinerary = agent()
    settings = own.brain._settings
    prospect = Prospect(THERE, 5, 40.0)
    offer = later_offer(settings, itinerary, PRESENCE, prospect, 3 * PERIOD_S)
    there = itinerary.next_stops(THERE, 3 * PERIOD_S - 40.0, 5)
    assert (offer.x_m, offer.y_m, offer.arrival_s) == (HERE.x_m, HERE.y_m, 1.0)
    assert offer.stops[0].task_index == 6
    assert [replace(stop, finish_offset_s=0.0) for stop in offer.stops] == [
        replace(stop, finish_offset_s=0.0) for stop in there
    ]
    assert [stop.finish_offset_s for stop in offer.stops] == pytest.approx(
        [stop.finish_offset_s + 36.0 for stop in there]
    )


def test_who_is_too_late_for_what_is_ahead_goes_on_when_it_leaves() -> None:
    """No stop is finished before the departure."""
    own, itinerary = agent()
    late = replace(PRESENCE, arrival_s=60.0, departure_s=60.0 + DURATION_S)
    offer = later_offer(own.brain._settings, itinerary, late, Prospect(THERE, 5, 40.0), 90.0)
    expected = itinerary.next_stops(THERE, 90.0 - 60.0 - DURATION_S, 5)
    assert offer.stops == expected
