"""How a topic was offered, as a bag tells it.

``Quality``       the part of a quality of service that a publisher is made from
``read_quality``  from a channel's ``offered_qos_profiles``
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Any, Final

import yaml

from tlcomm_core.errors import InputError

__all__ = ["Quality", "read_quality"]

# Older bags have rmw's numbers in the place of names.
_KEEP_ALL: Final = {"keep_all", 2}
_RELIABLE: Final = {"reliable", 1}
_LATCHED: Final = {"transient_local", 1}


@dataclass(frozen=True, slots=True)
class Quality:
    """The part of a quality of service that a publisher is made from.

    Attributes:
        depth: how many messages are kept for those who are late or slow; ``None`` for all.
        reliable: whether a lost message is sent again.
        latched: whether who comes later gets what is kept (transient local).
    """

    depth: int | None = 10
    reliable: bool = True
    latched: bool = False


@lru_cache
def read_quality(profiles: str) -> Quality:
    """Return the quality that serves whoever was served by these profiles.

    Several publishers may have offered a topic differently; of each policy the one with the most
    to offer is taken. Without any profile it is ROS's default.

    Args:
        profiles: a list of rosbag2's profiles as YAML, or "".

    Raises:
        InputError: it is no such list.
    """
    try:
        offered = [_read_one(profile) for profile in yaml.safe_load(profiles) or ()]
    except (yaml.YAMLError, RecursionError, AttributeError, TypeError, ValueError) as error:
        raise InputError(f"offered_qos_profiles can't be read: {profiles[:60]!r}") from error
    if not offered:
        return Quality()
    depths = [own.depth for own in offered if own.depth is not None]
    return Quality(
        depth=max(depths) if len(depths) == len(offered) else None,
        reliable=any(own.reliable for own in offered),
        latched=any(own.latched for own in offered),
    )


def _read_one(profile: Any) -> Quality:  # noqa: ANN401 (whatever the YAML holds)
    depth = int(profile.get("depth", 0))
    return Quality(
        depth=None if profile.get("history") in _KEEP_ALL else max(depth, 1),
        reliable=profile.get("reliability") in _RELIABLE,
        latched=profile.get("durability") in _LATCHED,
    )
