"""Tests of ``tlcomm_tools.verification.recording``: recordings from bags."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from rosbags.rosbag2 import StoragePlugin, Writer
from rosbags.typesys import Stores, get_typestore

from support.measuring_corridor import measuring_corridor
from support.recorded_bag import write_recording
from support.recorded_simulation import record
from tlcomm_core.errors import InputError
from tlcomm_core.mission import Mission
from tlcomm_core.protocol.messages import BestResponse
from tlcomm_core.records import event_log
from tlcomm_core.scenario.site import Site
from tlcomm_tools.report.moves import read_best_responses
from tlcomm_tools.verification.findings import verify
from tlcomm_tools.verification.recording import Recording, read_recording


def test_a_bag_gives_back_the_recording(tmp_path: Path) -> None:
    """All that agents were told and did, to the bit; so it can be verified."""
    mission = Mission(Site.from_scenario(measuring_corridor(mode="exact")), 0, 1, None)
    written = record(mission)
    write_recording(tmp_path / "bag", written, measures=True)
    read = read_recording(tmp_path)
    assert sorted(read.said, key=repr) == sorted(written.said, key=repr)
    assert sorted(read.commanded, key=repr) == sorted(written.commanded, key=repr)
    assert sorted(read.readings, key=repr) == sorted(written.readings, key=repr)
    assert [own.stamp_ns for own in read.maps] == [own.stamp_ns for own in written.maps]
    assert np.array_equal(read.maps[0].free, written.maps[0].free)
    assert read.topics == written.topics
    assert read.end_ns == written.end_ns
    assert list(event_log(read.run.records)) == list(event_log(written.run.records))
    assert read.said
    assert read.readings
    assert verify(read).difference is None


def test_a_number_that_is_none_is_refused(tmp_path: Path, recording: Recording) -> None:
    """A message with a number that no agent would have heard is named."""
    index, said, word = next(
        (index, said, said.message)
        for index, said in enumerate(recording.said)
        if isinstance(said.message, BestResponse)
    )
    recording.said[index] = replace(said, message=replace(word, change_s=math.nan))
    write_recording(tmp_path / "bag", recording, measures=False)
    with pytest.raises(InputError, match="/best_response' can't be used: change: nan isn't finite"):
        read_recording(tmp_path)
    with pytest.raises(InputError, match="/best_response' can't be used: change: nan isn't finite"):
        read_best_responses(tmp_path)


def test_a_message_of_another_kind_is_refused(tmp_path: Path, recording: Recording) -> None:
    """What the file itself defines otherwise than we do is named by its topic."""
    bag, kind = tmp_path / "bag", "std_msgs/msg/String"
    write_recording(bag, recording, measures=False)
    store = get_typestore(Stores.ROS2_JAZZY)
    with Writer(tmp_path / "other", version=9, storage_plugin=StoragePlugin.MCAP) as writer:
        connection = writer.add_connection("/map", kind, typestore=store)
        writer.write(connection, 1, store.serialize_cdr(store.types[kind](data="here"), kind))
    (tmp_path / "other" / "other.mcap").rename(bag / "other.mcap")
    (bag / "metadata.yaml").unlink()
    with pytest.raises(InputError, match="a message on '/map' can't be used: "):
        read_recording(bag)
