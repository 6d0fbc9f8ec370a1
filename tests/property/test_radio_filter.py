"""What holds for every radio, however bad, and whatever is said to it."""

from dataclasses import dataclass

from hypothesis import given
from hypothesis import strategies as st

from tlcomm_core.agent.channel import Channel
from tlcomm_core.agent.radio import Radio
from tlcomm_core.protocol.messages import Confirmation, Message, PlanOffer
from tlcomm_core.protocol.size import size_bytes
from tlcomm_core.scenario import model
from tlcomm_core.units import nanoseconds

LATENCY_NS = 5_000_000
RANGE_M = 2.0
DISTANCES_M = {"a": 0.5, "b": 2.0}
END_NS = 10**12


@dataclass(frozen=True)
class Said:
    """A message with the time of saying."""

    message: Message
    sent_ns: int


def say(sender: str, kind: int, number: int, sent_ns: int) -> Said:
    """Return a message of one of two kinds."""
    offer, confirmation = PlanOffer(sender, number, (sender,), ()), (sender,)
    message = offer if kind else Confirmation(sender, number, 0, number, confirmation)
    return Said(message, sent_ns)


TIMES_NS = st.integers(0, 2 * 10**9)
SAID = st.lists(
    st.builds(say, st.sampled_from("abc"), st.integers(0, 1), st.integers(0, 9), TIMES_NS),
    # ROS keeps the order on a topic, so what is said at one instant on one topic can't be shuffled.
    unique_by=lambda said: (said.message.sender, type(said.message), said.sent_ns),
    max_size=20,
)
SHARES = st.floats(0.0, 1.0)
RADIOS = st.builds(
    model.Radio,
    loss=SHARES,
    loss_at_range=st.none() | SHARES,
    jitter_s=st.floats(0.0, 1.0),
    duplication=SHARES,
    bandwidth_bps=st.none() | st.floats(100.0, 1e6),
)


def made(radio: model.Radio, seed: int = 1) -> Radio:
    """Return a radio with two neighbours and a third agent out of range."""
    own = Radio(LATENCY_NS, Channel(radio, RANGE_M, seed, "me"))
    own.see_neighbours(0, DISTANCES_M)
    return own


def heard(own: Radio, said: list[Said], stops_ns: list[int]) -> list[tuple[int, Message]]:
    """Return what is heard when, asked at the stops and whenever something is due."""
    for each in said:
        own.receive(each.message, each.sent_ns)
    stops_ns = sorted({*stops_ns, *(each.sent_ns + LATENCY_NS for each in said)})
    found: list[tuple[int, Message]] = []
    while stops_ns or own.next_due_ns is not None:
        now_ns = min([time for time in (own.next_due_ns, *stops_ns[:1]) if time is not None])
        stops_ns = [stop_ns for stop_ns in stops_ns if stop_ns > now_ns]
        found += [(now_ns, each.message) for each in own.heard(now_ns)]
    return found


@given(RADIOS, SAID, st.permutations(range(20)), st.lists(TIMES_NS, max_size=5))
def test_neither_order_nor_other_instants_change_what_is_heard_when(
    radio: model.Radio, said: list[Said], order: list[int], stops_ns: list[int]
) -> None:
    """Taken off the air in any order, asked at any times: the same messages at the same times."""
    expected, counted = made(radio), made(radio)
    shuffled = [said[index] for index in order if index < len(said)]
    assert heard(counted, shuffled, stops_ns) == heard(expected, said, [])
    assert counted.undelivered == expected.undelivered


@given(RADIOS, SAID, st.permutations(range(20)))
def test_neither_does_the_order_when_all_is_asked_for_at_once(
    radio: model.Radio, said: list[Said], order: list[int]
) -> None:
    """However late they are asked for, messages are heard in the same order."""
    radios = made(radio), made(radio)
    for each in said:
        radios[0].receive(each.message, each.sent_ns)
    for index in order:
        for each in said[index : index + 1]:
            radios[1].receive(each.message, each.sent_ns)
    assert radios[0].heard(END_NS) == radios[1].heard(END_NS)
    assert radios[0].undelivered == radios[1].undelivered


@given(RADIOS, SAID)
def test_nothing_is_early_nor_later_than_it_may_be(radio: model.Radio, said: list[Said]) -> None:
    """The latency is the least, jitter and what the queue may take are the most."""
    slowest_ns = 0
    if radio.bandwidth_bps is not None:
        longest = max((size_bytes(each.message) for each in said), default=0)
        slowest_ns = 10**9 + nanoseconds(8 * longest / radio.bandwidth_bps) + 1
    most_ns = LATENCY_NS + nanoseconds(radio.jitter_s) + slowest_ns
    for now_ns, message in heard(made(radio), said, []):
        sent_ns = [each.sent_ns for each in said if each.message == message]
        assert any(LATENCY_NS <= now_ns - time_ns <= most_ns for time_ns in sent_ns)


@given(RADIOS, SAID)
def test_every_message_is_heard_once_or_twice_or_counted(
    radio: model.Radio, said: list[Said]
) -> None:
    """Nothing vanishes, nothing comes of nothing."""
    own = made(radio)
    messages = [message for _, message in heard(own, said, [])]
    lost = sum(own.undelivered.values())
    assert len(said) - lost <= len(messages) <= 2 * (len(said) - lost)
    assert own.undelivered["out of range"] == sum(each.message.sender == "c" for each in said)
    assert {*messages} <= {each.message for each in said}


@given(SAID, st.integers(0, 9))
def test_a_perfect_radio_is_the_latency_alone(said: list[Said], seed: int) -> None:
    """Every neighbour's message once, a latency after it was said; the seed doesn't matter."""
    found = heard(made(model.Radio(), seed), said, [])
    near = [each for each in said if each.message.sender in DISTANCES_M]
    assert sorted(now_ns for now_ns, _ in found) == sorted(e.sent_ns + LATENCY_NS for e in near)
    assert len(found) == len(near)
