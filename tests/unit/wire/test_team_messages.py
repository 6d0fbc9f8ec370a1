"""Tests of ``tlcomm_core.wire.team_messages``: fields by name, whoever made the message.

That every kind of message comes back to the bit is a test of the agents' wire and of recordings.
"""

import math
from array import array
from dataclasses import astuple
from types import SimpleNamespace
from typing import get_args

import numpy as np
import pytest

from tlcomm_core.game.offer import PlannedStop
from tlcomm_core.protocol.messages import EstimateExchange, Proposal, TeamMessage
from tlcomm_core.protocol.topics import TEAM_TOPICS
from tlcomm_core.wire.fields import WireError
from tlcomm_core.wire.team_messages import decode_message, decode_offer

HEADER = SimpleNamespace(stamp=SimpleNamespace(sec=1, nanosec=5))
COLUMNS = ("task_index", "stop_x", "stop_y", "stop_heading", "finish_offset")


def proposal(**changes: object) -> SimpleNamespace:
    """Return a proposal of nobody's strategies."""
    whole = {"header": HEADER, "sender": "west", "round": 1, "iteration": 1, "hop": 2}
    rest = {"candidate": "east", "potential": 3.0, "bound": 2.0, "strategies": []}
    return SimpleNamespace(**(whole | rest | changes))


def exchange(**changes: object) -> SimpleNamespace:
    """Return what somebody takes the field to be."""
    whole = {"header": HEADER, "sender": "west", "step": 3, "neighbours": 1, "asks": False}
    return SimpleNamespace(**(whole | {"value": 1.5, "known": []} | changes))


def offer(columns: list[object]) -> SimpleNamespace:
    """Return an offer of some stops, by columns."""
    numbers = dict.fromkeys(("arrival_time", "heading", "linear_speed", "angular_speed"), 1.0)
    place = SimpleNamespace(x=1.0, y=2.0)
    stops = dict(zip(COLUMNS, columns, strict=True))
    return SimpleNamespace(
        agent="west", position=place, forbidden=[], map_stamp=7, **numbers, **stops
    )


def test_every_kind_of_message_has_its_topic() -> None:
    """The topics are the protocol's, one for each of what agents say."""
    assert len(TEAM_TOPICS) == len(set(TEAM_TOPICS)) == len(get_args(TeamMessage))


def test_a_bound_may_be_missing() -> None:
    """Where nothing is proven it is −inf; other numbers are finite."""
    read, sent_ns = decode_message(proposal(bound=-math.inf), "proposal")
    assert isinstance(read, Proposal)
    assert (read.bound_s, sent_ns) == (-math.inf, 1_000_000_005)
    for changes in ({"bound": math.nan}, {"bound": math.inf}, {"potential": -math.inf}):
        with pytest.raises(WireError, match="isn't finite"):
            decode_message(proposal(**changes), "proposal")


def test_an_estimate_is_finite_and_somebody_s() -> None:
    """What isn't is refused by the field's name."""
    read, _ = decode_message(exchange(), "estimate_exchange")
    assert read == EstimateExchange("west", 3, 1, asks=False, value=1.5)
    for changes, reason in (
        ({"value": math.inf}, "value: inf isn't finite"),
        ({"sender": ""}, "sender: a name has 1 to 255 characters, not 0"),
        ({"known": [SimpleNamespace()] * 1001}, "known: 1001 are more than 1000"),
    ):
        with pytest.raises(WireError, match=reason):
            decode_message(exchange(**changes), "estimate_exchange")


def test_stops_are_plain_numbers_from_any_array() -> None:
    """Arrays of ROS and of a bag's decoder give the same stops, which repr and JSON know."""
    rows = [(1, 2.0, 3.0, 0.5, 4.0), (2, 2.5, 3.5, 0.25, 8.0)]
    columns = list(zip(*rows, strict=True))
    of_ros = [array("I", columns[0]), *(array("d", column) for column in columns[1:])]
    of_bags = [np.array(columns[0], np.uint32), *map(np.array, columns[1:])]
    stops = tuple(PlannedStop(*row) for row in rows)
    for made in (of_ros, of_bags):
        read = decode_offer(offer(made)).stops
        assert read == stops
        assert {type(value) for stop in read for value in astuple(stop)} == {int, float}


def test_columns_of_stops_belong_together() -> None:
    """As many of each, all finite."""
    indices, numbers = np.array([1], np.uint32), np.array([1.0])
    with pytest.raises(WireError, match="columns of \\[1, 1, 1, 1, 2\\] stops"):
        decode_offer(offer([indices, numbers, numbers, numbers, np.array([1.0, 2.0])]))
    with pytest.raises(WireError, match="a stop has a number that isn't finite"):
        decode_offer(offer([indices, numbers, numbers, np.array([math.nan]), numbers]))
