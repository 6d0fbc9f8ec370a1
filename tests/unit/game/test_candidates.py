"""Candidates from offers, with real travel times."""

import math

import numpy as np
import pytest

from tlcomm_core.game.candidates import ROUNDING_S, candidates
from tlcomm_core.game.offer import MemberOffer, PlannedStop
from tlcomm_core.geometry import Pose
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.travel import HEADINGS_RAD, Motion, TravelTimes

WINDOW_S = (60.0, 120.0)


@pytest.fixture(scope="module")
def travel() -> TravelTimes:
    """5 m × 4 m with a wall, and a closed chamber in the upper right corner."""
    walls = [(2.0, 1.0, 2.5, 4.0), (4.0, 3.0, 4.5, 4.0), (4.0, 3.0, 5.0, 3.5)]
    return TravelTimes(Grid((5.0, 4.0), 0.5, walls), Motion(1.0, 1.5, 0.01))


def offer(*stops: tuple[float, float, int, float]) -> MemberOffer:
    """Return an offer with stops (x, y, lattice heading, finish offset) from task 7 on."""
    return MemberOffer(
        agent="a",
        arrival_s=1.0,
        x_m=0.25,
        y_m=0.25,
        yaw_rad=0.0,
        linear_mps=1.0,
        angular_radps=1.5,
        stops=tuple(
            PlannedStop(7 + h, x_m, y_m, HEADINGS_RAD[k], offset_s)
            for h, (x_m, y_m, k, offset_s) in enumerate(stops)
        ),
    )


SHUTTLE = offer((1.25, 3.25, 2, 10.0), (3.25, 3.25, 0, 30.0), (1.25, 3.25, 4, 50.0))


def test_entries_are_sums_of_legs(travel: TravelTimes) -> None:
    """Each arrival and detour is what the legs there, onward and direct take one by one."""
    table = candidates(SHUTTLE, 5.0, WINDOW_S, travel)
    assert table.agent == "a"
    assert table.task_index.tolist() == [7, 8]
    checked = 0
    for h, (stop, following) in enumerate(zip(SHUTTLE.stops[:-1], SHUTTLE.stops[1:], strict=True)):
        pose = Pose(stop.x_m, stop.y_m, stop.yaw_rad)
        target = travel.grid.location_at(following.x_m, following.y_m)
        assert target is not None
        for z in np.flatnonzero(np.isfinite(table.arrival_s[h])).tolist():
            there = travel.leg_from(pose, z)
            onward_s = travel.leg_to(there.arrival, target).duration_s
            direct_s = travel.leg_to(pose, target).duration_s
            extra_s = there.duration_s + onward_s - direct_s
            assert table.arrival_s[h, z] == pytest.approx(
                5.0 + stop.finish_offset_s + there.duration_s, abs=1e-9
            )
            assert table.extra_s[h, z] == pytest.approx(extra_s, abs=1e-9)
            checked += 1
    assert checked > 100


def test_the_closed_chamber_is_inadmissible(travel: TravelTimes) -> None:
    """Places that no path leads to are +inf in both tables; all others are finite here."""
    table = candidates(SHUTTLE, 5.0, WINDOW_S, travel)
    chamber = travel.grid.location_at(4.75, 3.75)
    cut_off = travel.grid.components == travel.grid.components[chamber]
    assert cut_off.any()
    assert (np.isinf(table.arrival_s) == cut_off).all()
    assert (np.isinf(table.extra_s) == cut_off).all()


def test_a_place_on_the_way_is_no_detour(travel: TravelTimes) -> None:
    """The present place and the next stop's cost nothing extra; none costs less than nothing."""
    table = candidates(SHUTTLE, 5.0, WINDOW_S, travel)
    here, there = (travel.grid.location_at(x_m, 3.25) for x_m in (1.25, 3.25))
    assert table.extra_s[0][[here, there]] == pytest.approx([0.0, 0.0], abs=1e-9)
    assert table.extra_s.min() >= -1e-9


def test_staying_put_costs_nothing_whatever_the_yaw(travel: TravelTimes) -> None:
    """An agent that keeps a yaw between two headings isn't charged, or paid, for the difference."""
    first, second, _ = SHUTTLE.stops
    for yaw_rad in (0.3, -2.0, math.pi / 8):
        stops = (PlannedStop(0, first.x_m, first.y_m, yaw_rad, 10.0), second)
        table = candidates(
            MemberOffer("a", 1.0, 0.25, 0.25, 0.0, 1.0, 1.5, stops), 5.0, WINDOW_S, travel
        )
        here = travel.grid.location_at(first.x_m, first.y_m)
        assert table.extra_s[0, here] == 0.0


def test_working_twice_at_one_place_charges_both_ways(travel: TravelTimes) -> None:
    """With π^h = π^{h+1} the direct way is nothing, so the detour is the way there and back."""
    twice = offer((1.25, 3.25, 2, 10.0), (1.25, 3.25, 2, 14.0))
    table = candidates(twice, 5.0, WINDOW_S, travel)
    assert table.extra_s[0, travel.grid.location_at(1.25, 3.75)] > 1.0
    assert table.extra_s[0, travel.grid.location_at(1.25, 3.25)] == 0.0


@pytest.mark.parametrize(("early_s", "admissible"), [(0.5, False), (2.0, True)])
def test_the_end_of_the_window_is_kept_clear(
    travel: TravelTimes, early_s: float, admissible: bool
) -> None:
    """An arrival counts only if it is before the window's end by more than the rounding."""
    finish_s = WINDOW_S[1] - early_s * ROUNDING_S - 5.0
    table = candidates(
        offer((0.25, 0.25, 0, finish_s), (0.75, 0.25, 0, 200.0)), 5.0, WINDOW_S, travel
    )
    here = travel.grid.location_at(0.25, 0.25)
    assert (len(table.task_index) > 0) is admissible
    if admissible:
        assert np.flatnonzero(np.isfinite(table.arrival_s[0])).tolist() == [here]
        assert np.flatnonzero(np.isfinite(table.extra_s[0])).tolist() == [here]


def test_a_margin_is_kept_free_too(travel: TravelTimes) -> None:
    """With 3 s to spare, arriving 2 s before the window's end is too late, 4 s isn't."""
    for early_s, rows in ((2.0, 0), (4.0, 1)):
        finish_s = WINDOW_S[1] - early_s - 5.0
        stops = offer((0.25, 0.25, 0, finish_s), (0.75, 0.25, 0, 200.0))
        assert len(candidates(stops, 5.0, WINDOW_S, travel, 3.0).task_index) == rows


def test_rows_without_admissible_entries_are_dropped(travel: TravelTimes) -> None:
    """A stop that is finished too late has no row, and the index of the others stays theirs."""
    late = offer((1.25, 3.25, 2, 10.0), (3.25, 3.25, 0, 116.0), (1.25, 3.25, 4, 130.0))
    table = candidates(late, 5.0, WINDOW_S, travel)
    assert table.task_index.tolist() == [7]
    assert table.arrival_s.shape == table.extra_s.shape == (1, len(travel.grid))


def test_a_single_stop_gives_no_candidate(travel: TravelTimes) -> None:
    """The last stop is only what follows its forerunner."""
    table = candidates(offer((1.25, 3.25, 2, 10.0)), 5.0, WINDOW_S, travel)
    assert table.arrival_s.shape == (0, len(travel.grid))


def test_a_stop_in_a_wall_gives_no_candidate(travel: TravelTimes) -> None:
    """What another map let an agent plan isn't admissible here, on the way there or back."""
    free, closed = (1.25, 3.25, 2, 1.0), (2.25, 2.25, 0, 2.0)
    for stops in ([free, closed], [closed, free]):
        assert not len(candidates(offer(*stops), 5.0, WINDOW_S, travel).task_index)
    rest = candidates(offer(closed, free, (1.25, 3.25, 2, 3.0)), 5.0, WINDOW_S, travel)
    assert rest.task_index.tolist() == [8]
