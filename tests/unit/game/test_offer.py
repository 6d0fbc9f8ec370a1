"""What agents offer."""

import math
from dataclasses import replace

import pytest

from tlcomm_core.game.offer import (
    MAX_STOPS,
    MemberOffer,
    PlannedStop,
    next_stops,
    offer_flaw,
)
from tlcomm_core.geometry import Pose
from tlcomm_core.planning.plan import LocalPlan, PlanStep
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.travel import Motion, TravelTimes

TRAVEL = TravelTimes(Grid((6.0, 1.0), 0.5, [(5.0, 0.0, 5.5, 1.0)]), Motion(1.0, math.pi / 2))
START = Pose(0.25, 0.25, 0.0)


def step(x_m: float, duration_s: float) -> PlanStep:
    """Return a step in the corridor."""
    location = TRAVEL.grid.location_at(x_m, 0.25)
    assert location is not None
    return PlanStep("r", location, "act", duration_s, frozenset(), satisfies=False)


def plan(*suffix: PlanStep, prefix: tuple[PlanStep, ...] = ()) -> LocalPlan:
    """Return a plan; its costs don't matter here."""
    return LocalPlan(prefix, suffix, 0.0, 1.0, 1.0, 0.0, 0.0, frozenset())


SHUTTLE = plan(step(4.25, 4.0), step(0.25, 4.0))


def test_stops_chain_driving_and_acting() -> None:
    """Offsets add straights, turns and actions; headings are those of the last straight."""
    stops = next_stops(SHUTTLE, 0, START, TRAVEL, 20.0)
    # 4 m and 4 s; then half a turn at 90°/s, 4 m and 4 s; and so on.
    assert [stop.finish_offset_s for stop in stops] == pytest.approx([8.0, 18.0, 28.0])
    assert [stop.x_m for stop in stops] == [4.25, 0.25, 4.25]
    assert [abs(stop.yaw_rad) for stop in stops] == pytest.approx([0.0, math.pi, 0.0])


def test_the_last_stop_is_the_first_beyond_the_horizon() -> None:
    """A stop finished exactly at the horizon is followed by one more."""
    assert len(next_stops(SHUTTLE, 0, START, TRAVEL, 17.9)) == 2
    assert len(next_stops(SHUTTLE, 0, START, TRAVEL, 18.1)) == 3


def test_there_is_always_a_task_and_its_successor() -> None:
    """Even when the first step takes longer than the horizon, two stops are offered."""
    assert len(next_stops(SHUTTLE, 0, START, TRAVEL, 1.0)) == 2


def test_the_index_runs_on_through_prefix_and_suffix() -> None:
    """Offers begin at the next step and count on, whatever pass of the suffix it is in."""
    longer = plan(step(4.25, 4.0), step(0.25, 4.0), prefix=(step(2.25, 1.0),))
    stops = next_stops(longer, 6, START, TRAVEL, 10.0)
    assert [(stop.task_index, stop.x_m) for stop in stops] == [(6, 0.25), (7, 4.25)]
    assert next_stops(longer, 0, START, TRAVEL, 0.0)[0].x_m == 2.25


def test_steps_without_time_are_cut_off() -> None:
    """A plan whose steps take no time doesn't make an endless offer."""
    assert len(next_stops(plan(step(0.25, 0.0)), 0, START, TRAVEL, 10.0)) == MAX_STOPS


@pytest.fixture
def good() -> MemberOffer:
    """Return an offer as an agent makes it."""
    stops = next_stops(SHUTTLE, 3, START, TRAVEL, 30.0)
    return MemberOffer("a", 5.0, 0.25, 0.25, 0.0, 1.0, math.pi / 2, stops)


def test_an_own_offer_has_no_flaw(good: MemberOffer) -> None:
    """What ``next_stops`` makes can be used."""
    assert offer_flaw(good, TRAVEL.grid) is None


@pytest.mark.parametrize(
    ("changes", "complaint"),
    [
        ({"linear_mps": 0.0}, "speeds 0.0 m/s"),
        ({"angular_radps": math.nan}, "nan rad/s"),
        ({"angular_radps": math.inf}, "inf rad/s"),
        ({"arrival_s": math.nan}, "arrival at nan s"),
        ({"x_m": 5.25}, "Pose(x_m=5.25, y_m=0.25, yaw_rad=0.0) isn't in a free cell"),
        ({"x_m": math.nan}, "Pose(x_m=nan"),
        ({"yaw_rad": math.inf}, "yaw_rad=inf"),
        ({"x_m": 5.75}, "can't be reached"),
        ({"stops": ()}, "0 stops; expected 2 to 256"),
    ],
)
def test_flaws_of_an_offer_are_named(
    good: MemberOffer, changes: dict[str, object], complaint: str
) -> None:
    """Whatever would break the candidates is found, and quoted."""
    flaw = offer_flaw(replace(good, **changes), TRAVEL.grid)
    assert flaw is not None
    assert complaint in flaw


@pytest.mark.parametrize(
    ("changes", "complaint"),
    [
        ({"task_index": 9}, "task 9 follows task 3"),
        ({"finish_offset_s": 0.5}, "is finished before the one that it follows"),
        ({"finish_offset_s": math.inf}, "is finished before the one that it follows"),
        ({"finish_offset_s": math.nan}, "is finished before the one that it follows"),
        ({"y_m": -0.25}, "isn't in a free cell"),
        ({"x_m": 5.75}, "can't be reached"),
        ({"yaw_rad": math.nan}, "yaw_rad=nan"),
    ],
)
def test_flaws_of_a_stop_are_named(
    good: MemberOffer, changes: dict[str, float], complaint: str
) -> None:
    """The same for its second stop."""
    first, second, *rest = good.stops
    stops = (first, replace(second, **changes), *rest)
    flaw = offer_flaw(replace(good, stops=stops), TRAVEL.grid)
    assert flaw is not None
    assert complaint in flaw


@pytest.mark.parametrize("offset_s", [-1.0, math.nan])
def test_a_first_stop_before_the_departure_is_a_flaw(good: MemberOffer, offset_s: float) -> None:
    """Nothing is finished before the agent has left."""
    first, *rest = good.stops
    stops: tuple[PlannedStop, ...] = (replace(first, finish_offset_s=offset_s), *rest)
    flaw = offer_flaw(replace(good, stops=stops), TRAVEL.grid)
    assert flaw is not None
    assert "before the departure" in flaw
