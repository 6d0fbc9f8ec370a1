"""The plans that agents laid open, read from a bag."""

import math
from dataclasses import replace
from pathlib import Path

from rosbags.typesys.store import Typestore

from support.gate import gate
from support.hand_made_run import SHARE
from support.recorded_bag import write_recording
from support.recorded_simulation import record
from tlcomm_core.mission import Mission
from tlcomm_core.protocol.messages import PlanOffer
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate
from tlcomm_tools.bag.container import read_container
from tlcomm_tools.bag.definitions import load_typestore
from tlcomm_tools.bag.offers import read_offers
from tlcomm_tools.bag.reader import find_files, read_run

MISSION = Mission(Site.from_scenario(gate()), 0, 2, None)
TYPE = "tlcomm_msgs/msg/PlanOffer"


def stored_offers(folder: Path) -> dict[str, list[bytes]]:
    """Write a bag; return the messages on each agent's topic of offers."""
    write_recording(folder, record(MISSION), measures=False)
    container = read_container(find_files(folder)[0], lambda own: own.type == TYPE)
    found: dict[str, list[bytes]] = {}
    for number, _, data in container.messages:
        found.setdefault(container.channels[number].topic.split("/")[1], []).append(data)
    return found


def big_endian(store: Typestore, data: bytes) -> bytes:
    """Return the same message in the other order of bytes."""
    message = store.deserialize_cdr(data, TYPE)
    return bytes(store.serialize_cdr(message, TYPE, little_endian=False))


def test_offers_are_those_of_the_simulation(tmp_path: Path) -> None:
    """Each agent's own, once for each round, at the time of saying it first."""
    write_recording(tmp_path / "bag", record(MISSION), measures=False)
    offers = simulate(MISSION).records.offers
    assert sorted(read_run(tmp_path / "bag").records.offers, key=repr) == sorted(offers, key=repr)
    assert len(offers) == 3 * len(MISSION.site.scenario.agents)


def test_however_messages_are_laid_out(tmp_path: Path) -> None:
    """In the other order of bytes nothing is found by a glance, but the same offers."""
    store = load_typestore(SHARE)
    for agent, messages in stored_offers(tmp_path / "bag").items():
        swapped = [big_endian(store, data) for data in messages]
        found = read_offers(store, agent, messages, ())
        assert read_offers(store, agent, swapped, ()) == found != []


def test_another_plan_after_another_arrival_is_found(tmp_path: Path) -> None:
    """Though for the same round; one said again isn't."""
    store = load_typestore(SHARE)
    agent, (first, *_) = next(iter(stored_offers(tmp_path / "bag").items()))
    message = store.deserialize_cdr(first, TYPE)
    own = next(it for it in message.offers if it.agent == agent)
    index = message.offers.index(own)
    message.offers[index] = replace(own, arrival_time=own.arrival_time + 1.0)
    message.header.stamp.sec += 1
    later = bytes(store.serialize_cdr(message, TYPE))
    messages = [first, first, later, later]
    stamp_ns = read_offers(store, agent, messages, ())[0].stamp_ns
    assert len(read_offers(store, agent, messages, ())) == 1
    found = read_offers(store, agent, messages, (stamp_ns, stamp_ns + 500_000_000))
    assert [it.offer.arrival_s - found[0].offer.arrival_s for it in found] == [0.0, 1.0]


def test_numbers_that_are_not_finite_are_left_out(tmp_path: Path) -> None:
    """The next message for the round counts instead."""
    store = load_typestore(SHARE)
    agent, (first, *_) = next(iter(stored_offers(tmp_path / "bag").items()))
    message = store.deserialize_cdr(first, TYPE)
    message.offers[:] = [replace(own, heading=math.nan) for own in message.offers]
    bad = bytes(store.serialize_cdr(message, TYPE))
    assert read_offers(store, agent, [bad], ()) == []
    assert read_offers(store, agent, [bad, first], ()) == read_offers(store, agent, [first], ())


def test_offers_carry_what_was_said(tmp_path: Path) -> None:
    """The offer is the very one that the agent's messages hold."""
    recording = record(MISSION)
    write_recording(tmp_path / "bag", recording, measures=False)
    said = {
        (own.agent, own.message.round, offer)
        for own in recording.said
        if isinstance(own.message, PlanOffer)
        for offer in own.message.offers
        if offer.agent == own.agent
    }
    read = read_run(tmp_path / "bag").records.offers
    assert {(own.agent, own.round, own.offer) for own in read} == said
