"""Meetings rehearsed over bad radio."""

import math
from dataclasses import replace

import pytest

from tlcomm_core.scenario.model import Radio
from tlcomm_tools.campaign import Campaign, rehearse

BAD = Campaign(
    agents=8,
    meetings=20,
    radio=Radio(loss=0.3, jitter_s=0.05, duplication=0.2),
    duration_s=5.0,
    proposes=True,
    seed=0,
)


@pytest.mark.parametrize(("agents", "meetings", "within_s"), [(8, 20, 1.2), (20, 3, 2.0)])
def test_on_a_bad_network_all_agree_long_before_the_meeting_is_over(
    agents: int, meetings: int, within_s: float
) -> None:
    """With 30 % lost, 50 ms of jitter, duplicates and messages out of order."""
    results = list(rehearse(replace(BAD, agents=agents, meetings=meetings)))
    assert len(results) == meetings
    assert max(result.agreed_s for result in results) < within_s


def test_best_responses_alone_take_longer() -> None:
    """Each of their iterations is as long as the proposals' only one."""
    proposing = list(rehearse(replace(BAD, meetings=5)))
    improving = list(rehearse(replace(BAD, meetings=5, proposes=False)))
    for one, other in zip(proposing, improving, strict=True):
        assert 2.0 * one.agreed_s < other.agreed_s
        assert one.messages < other.messages


def test_a_perfect_network_takes_a_few_hops() -> None:
    """The latency of each exchange, and no repetition."""
    for result in rehearse(replace(BAD, radio=Radio(), meetings=5)):
        assert result.agreed_s < 0.2
        assert result.messages < 60


def test_what_is_too_late_is_said() -> None:
    """With hardly a message heard nobody agrees before the meeting is over."""
    radio = Radio(loss=0.97)
    results = list(rehearse(replace(BAD, radio=radio, meetings=3)))
    assert [result.agreed_s for result in results] == [math.inf] * 3


def test_the_same_seed_has_the_same_outcome() -> None:
    """Each meeting follows from its own seed."""
    assert list(rehearse(replace(BAD, meetings=4)))[2:] == list(
        rehearse(replace(BAD, meetings=2, seed=2))
    )
