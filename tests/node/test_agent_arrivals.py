"""Counting a sender's messages although its topics overtake each other."""

from tlcomm_agent.arrivals import Arrivals


def test_a_later_message_does_not_stand_in_for_one_that_is_due() -> None:
    """The second message of a sender came first: the first is still missed."""
    arrivals = Arrivals(["other"], latency_ns=5)
    arrivals.note("other", sent_ns=12)
    assert not arrivals.are_complete({"other": 1}, now_ns=15)
    arrivals.note("other", sent_ns=10)
    assert arrivals.are_complete({"other": 1}, now_ns=15)
    assert not arrivals.are_complete({"other": 2}, now_ns=16)
    assert arrivals.are_complete({"other": 2}, now_ns=17)


def test_every_sender_counts_by_itself() -> None:
    """Many messages of one sender are none of another."""
    arrivals = Arrivals(["one", "two"], latency_ns=5)
    for sent_ns in range(3):
        arrivals.note("one", sent_ns)
    assert not arrivals.are_complete({"one": 3, "two": 1}, now_ns=100)
    arrivals.note("two", 50)
    assert arrivals.are_complete({"one": 3, "two": 1}, now_ns=100)
