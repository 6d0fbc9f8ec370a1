"""What follows from a scenario."""

import pytest

from tlcomm_core.scenario.loader import loads
from tlcomm_core.scenario.site import Site

TEXT = """\
name: small
workspace:
  size_m: [3.0, 1.0]
  cell_m: 0.5
  obstacles_m: [[1.5, 0.0, 2.0, 0.5]]
  regions:
    a: {at_m: [0.3, 0.3], radius_m: 0.3}
    b: {at_m: [0.5, 0.25], radius_m: 0.6}
    c: {at_m: [1.75, 0.25], radius_m: 0.51}
communication: {range_m: 1.0, period_s: 60.0, duration_s: 5.0}
motion: {linear_mps: 1.0, angular_radps: 1.5}
actions: {pick: 4.0}
agents:
  one: {start: [0.25, 0.75, 1.0], task: "G F a"}
  two: {start: [0.75, 0.75, 0], task: "G F b", motion: {position_tolerance_m: 0.05}}
"""
SITE = Site.from_scenario(loads(TEXT))


def test_a_region_is_visited_at_its_nearest_free_centre() -> None:
    """Ties go to the lowest location; a closed middle leads to a neighbour."""
    assert SITE.region_location["a"] == 0
    assert SITE.region_location["b"] == 0
    # (1.75, 0.25) is closed; its free neighbours at 0.5 m are (1.25, 0.25) and others.
    assert SITE.grid.locations_m[SITE.region_location["c"]].tolist() == [1.25, 0.25]


def test_regions_at_a_location_are_all_whose_disc_holds_it() -> None:
    """Overlapping regions count both; elsewhere there is none."""
    assert SITE.regions_at(0) == {"a", "b"}
    assert SITE.regions_at(1) == {"b"}
    far = SITE.grid.location_at(2.75, 0.75)
    assert far is not None
    assert SITE.regions_at(far) == frozenset()


def test_the_planned_range_leaves_room_for_two_controllers() -> None:
    """R less twice the largest tolerance."""
    assert SITE.planned_range_m == pytest.approx(0.9)


def test_motion_and_start_are_the_agents_own() -> None:
    """Speeds and pose come from the scenario, the allowance from the caller."""
    motion = SITE.motion_of("one", 0.05)
    assert (motion.linear_mps, motion.angular_radps, motion.segment_allowance_s) == (1.0, 1.5, 0.05)
    assert SITE.start_of("one").yaw_rad == 1.0
    assert SITE.action_durations("one") == {"pick": 4.0}


def test_regions_overlap_where_their_discs_share_a_point() -> None:
    """Never with themselves."""
    assert SITE.region_discs["b"] == (0.5, 0.25, 0.6)
    assert SITE.regions_beside == {
        "a": {"b"},
        "b": {"a"},
        "c": frozenset(),
    }
