"""What an agent's radio lets through."""

from itertools import permutations

from tlcomm_core.agent.radio import Radio
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.protocol.messages import BestResponse, Confirmation, Message, PlanOffer

LATENCY_NS = 5
STRATEGY = Strategy("a", 0.0, 0.0, 1, 10.0, 0.0)


def offer(sender: str, round_: int = 1) -> PlanOffer:
    """Return a message."""
    return PlanOffer(sender, round_, (sender,), ())


def radio(**neighbours_since: int) -> Radio:
    """Return a radio that is in range of each agent from a time on, given in ascending order."""
    made = Radio(LATENCY_NS)
    near: set[str] = set()
    for name, since_ns in neighbours_since.items():
        near.add(name)
        made.see_neighbours(since_ns, frozenset(near))
    return made


def test_only_neighbours_are_heard() -> None:
    """What comes from out of range is counted, and forgotten."""
    made = radio(near=0)
    made.receive(offer("near"), 0)
    made.receive(offer("far"), 0)
    assert made.heard(LATENCY_NS) == [offer("near")]
    assert made.out_of_range == 1
    made.see_neighbours(6, frozenset({"near", "far"}))
    assert made.heard(100) == []


def test_nobody_is_heard_before_a_neighbour_is_known() -> None:
    """Without any word of who is in range, nobody is."""
    made = Radio(LATENCY_NS)
    made.receive(offer("a"), 0)
    assert made.heard(LATENCY_NS) == []
    assert made.out_of_range == 1


def test_a_message_takes_its_latency() -> None:
    """It is heard a hop's latency after it was sent, not before, and once."""
    made = radio(a=0)
    made.receive(offer("a"), 10)
    assert made.heard(14) == []
    assert made.heard(15) == [offer("a")]
    assert made.heard(15) == []


def test_range_counts_at_the_arrival() -> None:
    """Who was near at sending, but not at arrival, isn't heard; and the other way round."""
    made = radio(a=0)
    made.receive(offer("a"), 10)
    made.receive(offer("b"), 10)
    made.see_neighbours(12, frozenset({"b"}))
    assert made.heard(15) == [offer("b")]


def test_a_change_at_the_very_arrival_counts() -> None:
    """A neighbourhood holds from its stamp on, that instant included."""
    made = radio(a=0)
    made.receive(offer("a"), 10)
    made.see_neighbours(15, frozenset())
    assert made.heard(15) == []


def test_a_change_after_the_arrival_does_not_count() -> None:
    """However late the message is asked for, within the radio's memory."""
    made = radio(a=0)
    made.receive(offer("a"), 10)
    made.receive(offer("b"), 10)
    made.see_neighbours(16, frozenset({"b"}))
    assert made.heard(9_000_000_000) == [offer("a")]


def test_a_message_slow_to_come_is_judged_by_its_time() -> None:
    """Free running, it may be taken off the air after links changed and others were heard."""
    made = radio(a=0)
    made.see_neighbours(16, frozenset({"b"}))
    assert made.heard(20) == []
    made.receive(offer("a"), 10)
    made.receive(offer("b"), 10)
    assert made.heard(30) == [offer("a")]


def test_a_message_older_than_the_memory_is_not_heard() -> None:
    """What can't be judged any more isn't let through."""
    made = radio(a=0)
    for second in range(1, 30):
        made.see_neighbours(second * 1_000_000_000, frozenset({"a"}))
        assert made.heard(second * 1_000_000_000) == []
    made.receive(offer("a"), 1_000_000_000)
    made.receive(offer("a", 2), 28_000_000_000)
    assert made.heard(29_000_000_000) == [offer("a", 2)]


def test_memory_is_bounded() -> None:
    """A radio that is told of its neighbours for ever keeps the latest only."""
    made = Radio(LATENCY_NS)
    for second in range(1000):
        made.see_neighbours(second * 1_000_000_000, frozenset({"a"}))
        made.heard(second * 1_000_000_000)
    assert len(made._since_ns) == len(made._neighbours) < 20


def test_the_order_of_hearing_is_that_of_arrival_sender_and_kind() -> None:
    """It doesn't depend on when messages were taken off the air."""
    ordered: list[tuple[Message, int]] = [
        (Confirmation("b", 1, 0, 7, ("b",)), 9),
        (offer("a"), 10),
        (BestResponse("a", 1, 0, 0, "a", 0.0, STRATEGY), 10),
        (Confirmation("a", 1, 0, 7, ("a",)), 10),
        (offer("b"), 10),
    ]
    for order in permutations(ordered):
        made = radio(a=0, b=0)
        for message, sent_ns in order:
            made.receive(message, sent_ns)
        assert made.heard(100) == [message for message, _ in ordered]


def test_messages_of_one_topic_keep_their_order() -> None:
    """Two of one kind, sender and instant are heard as they came, which ROS guarantees."""
    made = radio(a=0)
    made.receive(offer("a", 2), 10)
    made.receive(offer("a", 1), 10)
    assert made.heard(15) == [offer("a", 2), offer("a", 1)]
