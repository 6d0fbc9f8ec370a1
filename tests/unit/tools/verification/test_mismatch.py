"""Tests of ``tlcomm_tools.verification.mismatch``: where two values differ."""

import pytest

from tlcomm_core.agent.actions import Drive
from tlcomm_core.game.offer import MemberOffer, PlannedStop
from tlcomm_tools.verification.mismatch import Mismatch, first_mismatch


def offer(*offsets_s: float) -> MemberOffer:
    """Return an offer whose stops are finished then."""
    stops = tuple(PlannedStop(1, 0.0, 0.0, 0.0, offset_s) for offset_s in offsets_s)
    return MemberOffer("west", 0.0, 0.0, 0.0, 0.0, 1.0, 1.0, stops)


@pytest.mark.parametrize(
    ("recorded", "came_out", "where"),
    [
        (Drive(1.0, 0.0), Drive(1.0, 2.0), "angular_radps"),
        ((Drive(1.0, 0.0), 3), (Drive(1.0, 0.0), 4), "[1]"),
        (offer(1.0, 2.0), offer(1.0, 2.5), "stops[1].finish_offset_s"),
        (offer(1.0), offer(1.0, 2.0), "stops"),
        (Drive(1.0, 0.0), offer(), ""),
    ],
)
def test_the_first_part_that_differs_is_found(
    recorded: object, came_out: object, where: str
) -> None:
    """As deep inside as both are made alike."""
    found = first_mismatch(recorded, came_out)
    assert found is not None
    assert found.where == where


def test_both_parts_are_given() -> None:
    """As they stand in the two values."""
    assert first_mismatch(Drive(1.0, 0.0), Drive(0.5, 0.0)) == Mismatch("linear_mps", 1.0, 0.5)


def test_equal_values_have_no_mismatch() -> None:
    """However deep."""
    assert first_mismatch(offer(1.0, 2.0), offer(1.0, 2.0)) is None
