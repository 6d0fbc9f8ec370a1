"""Tests of ``tlcomm_tools.bag.messages``: any of a bag's messages."""

from pathlib import Path

import pytest

from support.hand_made_run import AGENTS, MESSAGES, hand_made_records, write_bag
from tlcomm_core.errors import InputError
from tlcomm_tools.bag.container import Channel
from tlcomm_tools.bag.messages import read_messages
from tlcomm_tools.bag.topics import recorded_topics


def is_confirmation(channel: Channel) -> bool:
    """Tell whether agents confirm on it."""
    return channel.topic.endswith("/confirmation")


def test_what_is_wanted_is_decoded(tmp_path: Path) -> None:
    """With whose it is; of the other topics the names are known."""
    write_bag(tmp_path / "bag", hand_made_records())
    bag = read_messages(tmp_path, is_confirmation)
    senders = [message.agent for message in bag.messages]
    assert {agent: senders.count(agent) for agent in AGENTS} == MESSAGES
    assert {message.topic for message in bag.messages} == {"confirmation"}
    assert all(message.content.sender == message.agent for message in bag.messages)
    assert bag.topics == {topic.name for topic in recorded_topics(AGENTS)}


def test_a_damaged_bag_is_read_as_far_as_it_goes(tmp_path: Path) -> None:
    """Its whole messages are there."""
    writer = write_bag(tmp_path / "bag", hand_made_records())
    data = writer.path.read_bytes()
    writer.path.write_bytes(data[: data.index(b"\x0f\x04\x00\x00\x00\x00\x00\x00\x00")])
    found = read_messages(tmp_path, is_confirmation).messages
    assert len(found) == sum(MESSAGES.values())


def test_another_definition_than_the_messages_is_refused(tmp_path: Path) -> None:
    """What the file says of a type must fit what it holds."""
    writer = write_bag(tmp_path / "bag", hand_made_records())
    data = writer.path.read_bytes()
    assert b"uint64 digest" in data
    writer.path.write_bytes(data.replace(b"uint64 digest", b"string digest"))
    with pytest.raises(InputError, match=r"holds a message that can't be decoded"):
        read_messages(tmp_path, is_confirmation)
