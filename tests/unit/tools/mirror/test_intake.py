"""Tests of ``tlcomm_tools.mirror.intake``: what is shown of messages, and what isn't."""

import math

import numpy as np
from rosbags.typesys.store import Typestore

from support.hand_made_run import SHARE, hand_made_scenario
from tlcomm_core.game.offer import PlannedStop
from tlcomm_core.method import Method
from tlcomm_tools.bag.definitions import load_typestore
from tlcomm_tools.bag.topics import Topic
from tlcomm_tools.mirror.intake import Intake
from tlcomm_tools.mirror.picture import Picture

TOPIC = Topic("/east/plan_offer", "tlcomm_msgs/msg/PlanOffer", "east")


def plan_offer(store: Typestore, *, of: str, round_number: int, x_m: float) -> bytes:
    """Return what east says of somebody's one stop."""
    types = store.types
    point = types["geometry_msgs/msg/Point"](x=x_m, y=0.0, z=0.0)
    numbers = ("arrival_time", "heading", "linear_speed", "angular_speed")
    columns = ("stop_x", "stop_y", "stop_heading", "finish_offset")
    offer = types["tlcomm_msgs/msg/MemberOffer"](
        agent=of,
        position=point,
        forbidden=[],
        map_stamp=0,
        task_index=np.array([4], np.uint32),
        **dict.fromkeys(numbers, 1.0),
        **{column: np.array([2.0]) for column in columns},
    )
    stamp = types["builtin_interfaces/msg/Time"](sec=0, nanosec=0)
    header = types["std_msgs/msg/Header"](stamp=stamp, frame_id="map")
    message = types[TOPIC.type](
        header=header, sender="east", round=round_number, known=["east"], offers=[offer]
    )
    return bytes(store.serialize_cdr(message, TOPIC.type))


def test_an_agent_s_own_offer_is_shown() -> None:
    """Neither what it relays, nor an offer that no agent would take."""
    store = load_typestore(SHARE)
    picture = Picture(hand_made_scenario(), Method.TEAM)
    intake = Intake(picture, store)
    for of, round_number, x_m in (("east", 1, 3.0), ("west", 2, 3.0), ("east", 3, math.nan)):
        intake.take(TOPIC, plan_offer(store, of=of, round_number=round_number, x_m=x_m))
    shown = picture.agents["east"].offered
    assert shown is not None
    assert (shown[0], shown[1].stops) == (1, (PlannedStop(4, 2.0, 2.0, 2.0, 2.0),))
    assert picture.agents["west"].offered is None
