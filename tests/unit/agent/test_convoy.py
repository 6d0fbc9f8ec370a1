"""A team that goes together: turns and contractions."""

import math
from dataclasses import replace

import numpy as np
import pytest

from tlcomm_core.agent.approach import Approaches
from tlcomm_core.agent.convoy import Part, contraction, is_together, turn
from tlcomm_core.game.offer import MemberOffer, PlannedStop
from tlcomm_core.geometry import Pose, wrap_angle
from tlcomm_core.protocol.team import Team
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.travel import Motion, TravelTimes

GRID = Grid((6.0, 3.0), 0.5, [(2.0, 0.0, 2.5, 1.5)])
TRAVEL = TravelTimes(GRID, Motion(0.5, 1.5))
DEPARTURE_S = 10.0
HERE = (1.25, 0.75)


def offer_at(
    name: str,
    x_m: float,
    y_m: float,
    yaw_rad: float = 0.0,
    stops_m: tuple[tuple[float, float], ...] = ((4.25, 0.75), (4.25, 2.25)),
    busy_s: tuple[float, ...] = (4.0, 4.0, 4.0),
) -> MemberOffer:
    """Return an offer of an agent that has done one step, and is busy for a while at the next."""
    pose, offset_s, stops = Pose(x_m, y_m, yaw_rad), 0.0, []
    for index, (stop_m, at_stop_s) in enumerate(zip(stops_m, busy_s, strict=False), start=1):
        target = GRID.location_at(*stop_m)
        assert target is not None
        leg = TRAVEL.leg_to(pose, target)
        pose, offset_s = leg.arrival, offset_s + leg.duration_s + at_stop_s
        stops.append(PlannedStop(index, pose.x_m, pose.y_m, pose.yaw_rad, offset_s))
    return MemberOffer(name, 5.0, x_m, y_m, yaw_rad, 0.5, 1.5, tuple(stops))


def straight_s(part: Part) -> float:
    """Return when a part's first straight begins."""
    way = part.way
    x_m, y_m = way.leg.waypoints_m[0]
    ahead_rad = math.atan2(y_m - way.start.y_m, x_m - way.start.x_m)
    return way.begins_s + abs(wrap_angle(ahead_rad - way.start.yaw_rad)) / 1.5


def test_all_begin_the_first_straight_at_once() -> None:
    """Whatever their headings, nobody before the departure, and along the leader's way."""
    offers = [offer_at("abc"[k], *HERE, yaw_rad) for k, yaw_rad in enumerate((0.0, 3.0, -1.0))]
    parts = turn(offers, 1, DEPARTURE_S, TRAVEL)
    assert {part.way.leg.waypoints_m for part in parts} == {parts[1].way.leg.waypoints_m}
    assert [straight_s(part) for part in parts] == pytest.approx([straight_s(parts[1])] * 3)
    assert min(part.way.begins_s for part in parts) == DEPARTURE_S
    for part in parts:
        assert part.way.begins_s + part.way.leg.duration_s == pytest.approx(
            part.way.ends_s, abs=2e-3
        )


def test_all_go_to_the_leaders_place_and_it_acts_there() -> None:
    """It has arrived when it has acted; the others do no step."""
    offers = [offer_at("a", *HERE), offer_at("b", *HERE, stops_m=((5.25, 2.25), (5.25, 2.25)))]
    first, second = turn(offers, 0, DEPARTURE_S, TRAVEL)
    assert (first.steps, second.steps) == (1, 0)
    assert {(own.strategy.x_m, own.strategy.y_m) for own in (first, second)} == {(4.25, 0.75)}
    assert (first.strategy.task_index, second.strategy.task_index) == (1, 0)
    assert first.way.ends_s == second.way.ends_s == second.strategy.arrival_s
    assert first.strategy.arrival_s == pytest.approx(second.strategy.arrival_s + 4.0)
    assert first.strategy.extra_travel_s == 0.0
    target = GRID.location_at(5.25, 2.25)
    assert target is not None
    detour = TRAVEL.detour(Pose(*HERE, 0.0), target)
    place = GRID.location_at(4.25, 0.75)
    assert second.strategy.extra_travel_s == detour.extra_s[place]


def test_a_turn_goes_as_far_as_the_next_action() -> None:
    """By what is only visited, which the leader stops at for no time, and the others drive by."""
    stops_m = ((4.25, 0.75), (5.25, 2.25), (5.25, 2.25))
    offers = [
        offer_at("a", *HERE, stops_m=stops_m, busy_s=(0.0, 0.0, 4.0)),
        offer_at("b", *HERE, 1.0),
    ]
    first, second = turn(offers, 0, DEPARTURE_S, TRAVEL)
    assert (first.steps, first.strategy.task_index) == (3, 3)
    assert first.strategy.x_m == second.strategy.x_m == 5.25
    assert first.strategy.arrival_s == pytest.approx(second.strategy.arrival_s + 4.0)
    assert first.way.leg.arrival.x_m == 4.25
    corners_m = second.way.leg.waypoints_m
    assert corners_m[: len(first.way.leg.waypoints_m)] == first.way.leg.waypoints_m
    assert corners_m[-1] == (5.25, 2.25)
    # Nothing keeps it at what it visits in passing.
    assert (first.way.ends_s, second.way.ends_s) == (-math.inf, second.strategy.arrival_s)
    assert straight_s(first) == pytest.approx(straight_s(second))
    driven_s = offers[0].stops[2].finish_offset_s - 4.0
    assert second.way.ends_s == pytest.approx(first.way.begins_s + driven_s, abs=2e-3)


def test_without_actions_a_turn_is_a_visit() -> None:
    """As many as an offer lists would be too many for one turn."""
    offers = [offer_at("a", *HERE, busy_s=(0.0, 0.0))]
    (part,) = turn(offers, 0, DEPARTURE_S, TRAVEL)
    assert (part.steps, part.strategy.x_m) == (1, 4.25)
    assert part.strategy.arrival_s == part.way.ends_s


def test_who_is_a_little_off_misses_no_corner() -> None:
    """One so near that somebody may be past it isn't driven to; all meet at the next at once."""
    offers = [offer_at("a", 1.23, 0.76, 2.0), offer_at("b", 1.26, 0.74, -2.0)]
    parts = turn(offers, 0, DEPARTURE_S, TRAVEL, 0.06)
    (corner_m,) = {part.way.leg.waypoints_m[0] for part in parts}
    assert corner_m != HERE
    assert turn(offers, 0, DEPARTURE_S, TRAVEL)[0].way.leg.waypoints_m == (
        HERE,
        *parts[0].way.leg.waypoints_m,
    )
    times_s = [
        straight_s(part) + math.dist((part.way.start.x_m, part.way.start.y_m), corner_m) / 0.5
        for part in parts
    ]
    assert times_s[0] == pytest.approx(times_s[1], abs=1e-9)


def test_nobody_goes_where_no_way_leads() -> None:
    """The turn is over at once, and whoever is next may be luckier."""
    shut = Grid((6.0, 3.0), 0.5, [(2.0, 0.0, 2.5, 3.0)])
    offers = [offer_at("a", *HERE), offer_at("b", *HERE, 1.0)]
    parts = turn(offers, 0, DEPARTURE_S, TravelTimes(shut, TRAVEL.motion))
    assert {(part.steps, part.way.leg.waypoints_m) for part in parts} == {(0, ())}
    assert {(part.strategy.x_m, part.strategy.y_m) for part in parts} == {HERE}


def test_who_has_done_nothing_and_does_nothing_has_the_lowest_number() -> None:
    """There is none before 0."""
    fresh = offer_at("b", *HERE)
    stops = tuple(replace(stop, task_index=stop.task_index - 1) for stop in fresh.stops)
    _, part = turn([offer_at("a", *HERE), replace(fresh, stops=stops)], 0, DEPARTURE_S, TRAVEL)
    assert (part.strategy.task_index, part.steps) == (0, 0)


def test_together_is_who_is_at_one_place() -> None:
    """But for what controllers are off by."""
    offers = [offer_at(name, 1.25 + off_m, 0.75) for name, off_m in (("a", 0.0), ("b", 0.04))]
    assert is_together(offers, 0.0401)
    assert not is_together(offers, 0.0399)
    assert is_together(offers[:1], 0.0)


def within(range_m: float) -> Approaches:
    """Return the approaches of a team with such a range."""
    return Approaches(TRAVEL, Team(frozenset("ab"), range_m, 60.0, 5.0))


def test_the_outermost_go_straight_to_their_parents() -> None:
    """In a line of five both ends go next to the middle's neighbours; the rest stands still."""
    offers = [offer_at("abcde"[k], 3.25 + 0.5 * k, 0.75) for k in range(5)]
    parts = contraction(offers, within(0.6), DEPARTURE_S, TRAVEL)
    assert [part.strategy.x_m for part in parts] == [3.75, 3.75, 4.25, 4.75, 4.75]
    assert [len(part.way.leg.waypoints_m) for part in parts] == [1, 0, 0, 0, 1]
    assert {part.steps for part in parts} == {0}
    # The last one has to turn round first.
    assert parts[4].way.leg.duration_s == pytest.approx(math.pi / 1.5 + 0.5 / 0.5)
    (ends_s,) = {part.way.ends_s for part in parts}
    assert ends_s == pytest.approx(DEPARTURE_S + parts[4].way.leg.duration_s, abs=2e-3)


def test_contractions_come_to_an_end() -> None:
    """After at most as many as the graph has links from its middle to its edge."""
    rng = np.random.default_rng(1)
    for _ in range(20):
        places_m = [(3.25, 0.75)]
        while len(places_m) < 8:
            x_m, y_m = places_m[rng.integers(len(places_m))]
            angle = rng.uniform(0.0, math.tau)
            new_m = x_m + 0.5 * math.cos(angle), y_m + 0.5 * math.sin(angle)
            if GRID.location_at(*new_m) is not None and new_m[0] > 2.5:
                places_m.append(new_m)
        rounds = 0
        while len(set(places_m)) > 1:
            offers = [offer_at("abcdefgh"[k], *place_m) for k, place_m in enumerate(places_m)]
            parts = contraction(offers, within(0.51), DEPARTURE_S, TRAVEL)
            places_m = [(part.strategy.x_m, part.strategy.y_m) for part in parts]
            rounds += 1
        assert rounds <= 4


def test_without_links_all_go_to_the_first() -> None:
    """Some were displaced, or the map has closed straights."""
    offers = [offer_at("a", 3.25, 0.75), offer_at("b", 5.25, 0.75), offer_at("c", 5.25, 2.25)]
    parts = contraction(offers, within(1.6), DEPARTURE_S, TRAVEL)
    assert {(part.strategy.x_m, part.strategy.y_m) for part in parts} == {(3.25, 0.75)}
