"""Mirrors of the run made by hand, decoded or as bytes."""

from functools import cache
from pathlib import Path
from typing import Any

from rosbags.typesys.store import Typestore

from support.hand_made_run import (
    AGENTS,
    SHARE,
    hand_made_records,
    hand_made_scenario,
    serialize_run,
)
from tlcomm_core.method import Method
from tlcomm_core.records import RunRecords
from tlcomm_core.units import nanoseconds
from tlcomm_tools.bag.definitions import load_typestore, read_definition
from tlcomm_tools.bag.topics import recorded_topics
from tlcomm_tools.bag.writer import BagWriter
from tlcomm_tools.mirror.mirror import Mirror

__all__ = ["make_mirror", "mirror_run", "write_mirrored_bag"]

TOPICS = recorded_topics(AGENTS)
_NUMBERS = {topic.name: number for number, topic in enumerate(TOPICS)}


def make_mirror(store: Typestore) -> Mirror:
    """Return a mirror of the hand-made run, which hasn't begun."""
    return Mirror(hand_made_scenario(), Method.TEAM, TOPICS, store)


@cache
def _store() -> Typestore:
    return load_typestore(SHARE)


def mirror_run(until_s: float, records: RunRecords | None = None) -> dict[tuple[str, float], Any]:
    """Return what is mirrored up to a time, decoded, by topic and time (s)."""
    store = _store()
    mirror = make_mirror(store)
    for name, stamp_ns, data in serialize_run(store, records or hand_made_records()):
        mirror.take(_NUMBERS[name], stamp_ns, data)
    return {
        (mirror.topics[number].name, stamp_ns / 1e9): store.deserialize_cdr(
            data, mirror.topics[number].type
        )
        for number, stamp_ns, data in mirror.advance(nanoseconds(until_s))
    }


def write_mirrored_bag(folder: Path) -> Path:
    """Write the hand-made run and its mirrors as the recorder does; return the file."""
    store = _store()
    mirror = make_mirror(store)
    topics = (*TOPICS, *mirror.topics)
    definitions = {topic.type: read_definition(store, topic.type) for topic in topics}
    with BagWriter(folder, topics, definitions, {}) as writer:
        for name, stamp_ns, data in serialize_run(store, hand_made_records()):
            writer.write(_NUMBERS[name], stamp_ns, data)
            mirror.take(_NUMBERS[name], stamp_ns, data)
        for number, stamp_ns, data in mirror.advance(nanoseconds(25.0)):
            writer.write(len(TOPICS) + number, stamp_ns, data)
    return writer.path
