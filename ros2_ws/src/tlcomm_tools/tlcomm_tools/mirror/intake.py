"""Recorded messages, put into the picture.

``Intake``  decodes messages into a picture
"""

import contextlib
from collections.abc import Callable
from typing import Final

import numpy as np
from rosbags.typesys.store import Typestore

from tlcomm_core.game.offer import MemberOffer, PlannedStop
from tlcomm_core.units import NANOSECONDS_PER_SECOND
from tlcomm_tools import wire
from tlcomm_tools.bag.topics import Topic
from tlcomm_tools.mirror.odometry import decode_odometry
from tlcomm_tools.mirror.picture import Picture

__all__ = ["Intake"]

# Occupied as likely as not counts as occupied, and so does what isn't known (−1).
_OCCUPIED: Final = 50
_ODOMETRY: Final = "nav_msgs/msg/Odometry"

_Taker = Callable[[wire.DecodedMessage, str], None]


class Intake:
    """Decodes messages into a picture."""

    def __init__(self, picture: Picture, store: Typestore) -> None:
        """Take messages as a store defines them."""
        self._picture: Final = picture
        self._store: Final = store
        self._takers: Final[dict[str, _Taker]] = {
            "nav_msgs/msg/OccupancyGrid": self._take_map,
            "tlcomm_msgs/msg/Connectivity": self._take_connectivity,
            "tlcomm_msgs/msg/TaskEvent": self._take_event,
            "tlcomm_msgs/msg/TeamStrategy": self._take_strategy,
            "tlcomm_msgs/msg/PlanOffer": self._take_offers,
        }

    def wants(self, topic: Topic) -> bool:
        """Return whether the picture shows anything of a topic."""
        return topic.type == _ODOMETRY or topic.type in self._takers

    def take(self, topic: Topic, data: bytes) -> None:
        """Take a message of a topic that is wanted; one that makes no sense shows nothing."""
        if topic.type == _ODOMETRY:
            with contextlib.suppress(ValueError):
                self._picture.take_odometry(decode_odometry(data, topic.agent))
            return
        message = self._store.deserialize_cdr(data, topic.type)
        with contextlib.suppress(ValueError):
            self._takers[topic.type](message, topic.agent)

    def _take_connectivity(self, message: wire.DecodedMessage, _: str) -> None:
        self._picture.take_connectivity(wire.read_connectivity(message))

    def _take_event(self, message: wire.DecodedMessage, _: str) -> None:
        self._picture.take_event(wire.read_task_event(message))

    def _take_strategy(self, message: wire.DecodedMessage, agent: str) -> None:
        self._picture.agents[agent].held = wire.read_team_strategy(message, agent)

    def _take_offers(self, message: wire.DecodedMessage, agent: str) -> None:
        """Take what an agent offers itself; the rest of a message it only relays."""
        for offer in message.offers:
            if offer.agent == agent:
                self._picture.agents[agent].offered = (message.round, _read_offer(offer))

    def _take_map(self, message: wire.DecodedMessage, _: str) -> None:
        rows, columns = self._picture.site.grid.shape
        if (message.info.height, message.info.width) == (rows, columns):
            cells = np.asarray(message.data, dtype=np.int8).reshape(rows, columns)
            free = (cells >= 0) & (cells < _OCCUPIED)
            stamp = message.header.stamp
            map_ns = stamp.sec * NANOSECONDS_PER_SECOND + stamp.nanosec
            self._picture.charts.take(map_ns, free)


def _read_offer(offer: wire.DecodedMessage) -> MemberOffer:
    columns = (
        offer.task_index,
        offer.stop_x,
        offer.stop_y,
        offer.stop_heading,
        offer.finish_offset,
    )
    return MemberOffer(
        agent=offer.agent,
        arrival_s=offer.arrival_time,
        x_m=offer.position.x,
        y_m=offer.position.y,
        yaw_rad=offer.heading,
        linear_mps=offer.linear_speed,
        angular_radps=offer.angular_speed,
        stops=tuple(
            PlannedStop(*row) for row in zip(*(own.tolist() for own in columns), strict=True)
        ),
        avoided=tuple(offer.forbidden),
        map_ns=offer.map_stamp,
    )
