"""What an agent's radio lets through."""

from itertools import permutations

from tlcomm_core.agent.channel import LOST, Channel, Passage
from tlcomm_core.agent.radio import OUT_OF_RANGE, Heard, Radio
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.protocol.messages import (
    BestResponse,
    Confirmation,
    Message,
    PlanOffer,
    TeamMessage,
)
from tlcomm_core.scenario import model

LATENCY_NS = 5
CLEAR = Channel(model.Radio(), 1.0, 0, "me")
STRATEGY = Strategy("a", 0.0, 0.0, 1, 10.0, 0.0)


def offer(sender: str, round_: int = 1) -> PlanOffer:
    """Return a message."""
    return PlanOffer(sender, round_, (sender,), ())


def radio(**neighbours_since: int) -> Radio:
    """Return a radio that is in range of each agent from a time on, given in ascending order."""
    made = Radio(LATENCY_NS, CLEAR)
    near: dict[str, float] = {}
    for name, since_ns in neighbours_since.items():
        near[name] = 0.5
        made.see_neighbours(since_ns, dict(near))
    return made


def heard(made: Radio, now_ns: int) -> list[TeamMessage]:
    """Return what is heard by now."""
    return [own.message for own in made.heard(now_ns)]


def test_only_neighbours_are_heard() -> None:
    """What comes from out of range is counted, and forgotten."""
    made = radio(near=0)
    made.receive(offer("near"), 0)
    made.receive(offer("far"), 0)
    assert heard(made, LATENCY_NS) == [offer("near")]
    assert made.undelivered == {OUT_OF_RANGE: 1}
    made.see_neighbours(6, {"near": 0.5, "far": 1.0})
    assert heard(made, 100) == []


def test_nobody_is_heard_before_a_neighbour_is_known() -> None:
    """Without any word of who is in range, nobody is."""
    made = Radio(LATENCY_NS, CLEAR)
    made.receive(offer("a"), 0)
    assert heard(made, LATENCY_NS) == []
    assert made.undelivered == {OUT_OF_RANGE: 1}


def test_a_message_takes_its_latency() -> None:
    """It is heard a hop's latency after it was sent, not before, and once."""
    made = radio(a=0)
    made.receive(offer("a"), 10)
    assert heard(made, 14) == []
    assert heard(made, 15) == [offer("a")]
    assert heard(made, 15) == []


def test_range_counts_at_the_arrival() -> None:
    """Who was near at sending, but not at arrival, isn't heard; and the other way round."""
    made = radio(a=0)
    made.receive(offer("a"), 10)
    made.receive(offer("b"), 10)
    made.see_neighbours(12, {"b": 0.5})
    assert heard(made, 15) == [offer("b")]


def test_a_change_at_the_very_arrival_counts() -> None:
    """A neighbourhood holds from its stamp on, that instant included."""
    made = radio(a=0)
    made.receive(offer("a"), 10)
    made.see_neighbours(15, {})
    assert heard(made, 15) == []


def test_a_change_after_the_arrival_does_not_count() -> None:
    """However late the message is asked for, within the radio's memory."""
    made = radio(a=0)
    made.receive(offer("a"), 10)
    made.receive(offer("b"), 10)
    made.see_neighbours(16, {"b": 0.5})
    assert heard(made, 9_000_000_000) == [offer("a")]


def test_a_message_slow_to_come_is_judged_by_its_time() -> None:
    """Free running, it may be taken off the air after links changed and others were heard."""
    made = radio(a=0)
    made.see_neighbours(16, {"b": 0.5})
    assert heard(made, 20) == []
    made.receive(offer("a"), 10)
    made.receive(offer("b"), 10)
    assert heard(made, 30) == [offer("a")]


def test_a_message_older_than_the_memory_is_not_heard() -> None:
    """What can't be judged any more isn't let through."""
    made = radio(a=0)
    for second in range(1, 30):
        made.see_neighbours(second * 1_000_000_000, {"a": 0.5})
        assert heard(made, second * 1_000_000_000) == []
    made.receive(offer("a"), 1_000_000_000)
    made.receive(offer("a", 2), 28_000_000_000)
    assert heard(made, 29_000_000_000) == [offer("a", 2)]


def test_memory_is_bounded() -> None:
    """A radio that is told of its neighbours for ever keeps the latest only."""
    made = Radio(LATENCY_NS, CLEAR)
    for second in range(1000):
        made.see_neighbours(second * 1_000_000_000, {"a": 0.5})
        heard(made, second * 1_000_000_000)
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
        assert heard(made, 100) == [message for message, _ in ordered]


def test_messages_of_one_topic_keep_their_order() -> None:
    """Two of one kind, sender and instant are heard as they came, which ROS guarantees."""
    made = radio(a=0)
    made.receive(offer("a", 2), 10)
    made.receive(offer("a", 1), 10)
    assert heard(made, 15) == [offer("a", 2), offer("a", 1)]


class Staged(Channel):
    """A channel that does what a test says, by sender."""

    def __init__(self, passages: dict[str, Passage]) -> None:
        self._passages = passages

    def carry(self, message: Message, sent_ns: int, distance_m: float) -> Passage:
        """Return the passage of whoever is the sender."""
        del sent_ns, distance_m
        return self._passages[message.sender]


def test_what_the_channel_delays_is_heard_later_and_out_of_turn() -> None:
    """A copy comes after the fixed latency and its own delay; the radio tells when."""
    made = Radio(LATENCY_NS, Staged({"a": Passage((7,)), "b": Passage((2, 9))}))
    made.see_neighbours(0, {"a": 0.5, "b": 0.5})
    made.receive(offer("a"), 10)
    made.receive(offer("b"), 11)
    assert made.next_due_ns is None
    assert heard(made, 17) == []
    assert made.next_due_ns == 18
    assert heard(made, 18) == [offer("b")]
    assert heard(made, 22) == [offer("a")]
    assert made.next_due_ns == 25
    assert heard(made, 30) == [offer("b")]
    assert made.next_due_ns is None


def test_what_the_channel_loses_is_counted_with_its_reason() -> None:
    """It is never heard; what comes from out of range doesn't ask the channel."""
    made = Radio(LATENCY_NS, Staged({"a": Passage((), LOST)}), "too far")
    made.see_neighbours(0, {"a": 0.5})
    made.receive(offer("a"), 10)
    made.receive(offer("c"), 10)
    assert heard(made, 100) == []
    assert made.undelivered == {LOST: 1, "too far": 1}


def test_who_was_near_when_the_latency_had_passed_is_heard_however_late() -> None:
    """A random delay is no second chance to get out of range, nor into it."""
    made = Radio(LATENCY_NS, Staged({"a": Passage((50,)), "b": Passage((50,))}))
    made.see_neighbours(0, {"a": 0.5})
    made.receive(offer("a"), 10)
    made.receive(offer("b"), 10)
    made.see_neighbours(20, {"b": 0.5})
    assert heard(made, 100) == [offer("a")]


def test_what_is_heard_says_when_it_was_said() -> None:
    """By the sender's clock, also if that is ahead and the message counts as sent when taken."""
    made = Radio(0, CLEAR, lag_ns=100)
    made.see_neighbours(0, {"a": 0.5})
    made.receive(offer("a", 1), 10)
    made.receive(offer("a", 2), 30, taken_ns=20)
    assert made.heard(25) == [Heard(offer("a", 1), 10), Heard(offer("a", 2), 30)]


def test_running_freely_a_message_waits_for_news_of_the_neighbours() -> None:
    """It isn't decided on by what the agent knew longer before it than the lag."""
    made = Radio(0, CLEAR, lag_ns=100)
    made.see_neighbours(0, {"a": 0.5})
    made.receive(offer("a", 1), 100, taken_ns=110)
    made.receive(offer("a", 2), 101, taken_ns=110)
    assert heard(made, 110) == [offer("a", 1)]
    made.see_neighbours(90, {})
    assert heard(made, 120) == []
    assert made.undelivered == {OUT_OF_RANGE: 1}


def test_a_clock_may_lag_behind_the_senders_so_far() -> None:
    """What is said further ahead than the lag is heard when the own clock is that near to it."""
    made = Radio(0, CLEAR, lag_ns=100)
    made.see_neighbours(0, {"a": 0.5})
    made.receive(offer("a"), 90, taken_ns=10)
    assert heard(made, 10) == [offer("a")]
    made.see_neighbours(200, {"a": 0.5})
    made.receive(offer("a"), 290, taken_ns=10)
    assert heard(made, 189) == []
    assert heard(made, 190) == [offer("a")]
