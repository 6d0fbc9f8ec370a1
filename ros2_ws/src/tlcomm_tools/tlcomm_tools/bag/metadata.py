"""A bag's ``metadata.yaml`` (rosbag2, version 9).

``BagCounts``        what changes from one flush to the next
``render_metadata``  the file's text
``qos_text``         a topic's offered quality of service, as rosbag2 writes it

The text is made by hand, since it is made anew at every flush: PyYAML takes a hundred times longer.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from tlcomm_tools.bag.definitions import Definition
from tlcomm_tools.bag.topics import Topic

__all__ = ["BagCounts", "qos_text", "render_metadata"]

_QOS = """\
- history: keep_last
  depth: {depth}
  reliability: reliable
  durability: {durability}
  deadline:
    sec: 9223372036
    nsec: 854775807
  lifespan:
    sec: 9223372036
    nsec: 854775807
  liveliness: automatic
  liveliness_lease_duration:
    sec: 9223372036
    nsec: 854775807
  avoid_ros_namespace_conventions: false"""

_TOPIC = """\
    - topic_metadata:
        name: {name}
        type: {type}
        serialization_format: cdr
        offered_qos_profiles:
{qos}
        type_description_hash: {type_hash}
      message_count: {count}
"""

_FILE = """\
rosbag2_bagfile_information:
  version: 9
  storage_identifier: mcap
  duration:
    nanoseconds: {duration_ns}
  starting_time:
    nanoseconds_since_epoch: {start_ns}
  message_count: {count}
  topics_with_message_count:
{topics}  compression_format: ""
  compression_mode: ""
  relative_file_paths:
    - {path}
  files:
    - path: {path}
      starting_time:
        nanoseconds_since_epoch: {start_ns}
      duration:
        nanoseconds: {duration_ns}
      message_count: {count}
  custom_data: ~
  ros_distro: jazzy
"""


@dataclass(frozen=True, slots=True)
class BagCounts:
    """What a bag holds so far.

    Attributes:
        messages: per topic.
        span_ns: least and greatest log time, or ``None`` for an empty bag.
    """

    messages: tuple[int, ...]
    span_ns: tuple[int, int] | None


def qos_text(*, latched: bool) -> str:
    """Return the offered quality of service as YAML."""
    if latched:
        return _QOS.format(depth=10, durability="transient_local")
    return _QOS.format(depth=1000, durability="volatile")


def render_metadata(
    file_name: str,
    topics: Sequence[Topic],
    definitions: Mapping[str, Definition],
    counts: BagCounts,
) -> str:
    """Return the text of ``metadata.yaml``."""
    qos = {
        latched: "\n".join(f"          {line}" for line in qos_text(latched=latched).split("\n"))
        for latched in (False, True)
    }
    parts = [
        _TOPIC.format(
            name=topic.name,
            type=topic.type,
            qos=qos[topic.latched],
            type_hash=definitions[topic.type].type_hash,
            count=count,
        )
        for topic, count in zip(topics, counts.messages, strict=True)
    ]
    first_ns, last_ns = counts.span_ns or (0, 0)
    return _FILE.format(
        duration_ns=last_ns - first_ns,
        start_ns=first_ns,
        count=sum(counts.messages),
        topics="".join(parts),
        path=file_name,
    )
