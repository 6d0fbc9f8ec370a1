"""Tests of ``tlcomm_tools.live.intake``: what a page is told of messages."""

import math
from typing import Any

import pytest
from rosbags.typesys.store import Typestore

from support.hand_made_run import SHARE, hand_made_scenario
from tlcomm_core.protocol.messages import BestResponse
from tlcomm_tools.bag.definitions import load_typestore
from tlcomm_tools.live.intake import Intake, shown_topics


class Page:
    """Keeps what it is told."""

    def __init__(self) -> None:
        self.said: list[BestResponse] = []

    def take_response(self, said: BestResponse) -> None:
        """Take what somebody said."""
        self.said.append(said)


def response(store: Typestore, kind: str, *, sender: str, change_s: float) -> bytes:
    """Return a best response of an agent that would go to a place."""
    types = store.types
    stamp = types["builtin_interfaces/msg/Time"](sec=1, nanosec=0)
    strategy = types["tlcomm_msgs/msg/Strategy"](
        agent="east",
        location=types["geometry_msgs/msg/Point"](x=1.0, y=2.0, z=0.0),
        task_index=3,
        arrival_time=4.0,
        extra_travel=5.0,
    )
    message = types[kind](
        header=types["std_msgs/msg/Header"](stamp=stamp, frame_id="map"),
        sender=sender,
        round=1,
        iteration=0,
        hop=0,
        candidate="east",
        change=change_s,
        strategy=strategy,
    )
    return bytes(store.serialize_cdr(message, kind))


@pytest.mark.parametrize(
    ("sender", "change_s", "is_told"),
    [("east", -1.0, True), ("", -1.0, False), ("e", math.nan, False)],
)
def test_responses_that_no_agent_would_take_show_nothing(
    sender: str, change_s: float, is_told: bool
) -> None:
    """What has a nameless sender, or a number that is none, is passed over."""
    store, topics, page = load_typestore(SHARE), shown_topics(hand_made_scenario()), Page()
    number = [topic.name for topic in topics].index("/east/best_response")
    told: Any = page
    data = response(store, topics[number].type, sender=sender, change_s=change_s)
    Intake(told, topics, store).take((number, data))
    assert [own.change_s for own in page.said] == ([change_s] if is_told else [])
