"""Tests of ``tlcomm_tools.runtime.backlog``."""

from tlcomm_tools.bag.topics import recorded_topics
from tlcomm_tools.runtime.backlog import FOR_EVER, Backlog
from tlcomm_tools.runtime.ledger import Expected

AGENTS = ("a", "b")
TOPICS = recorded_topics(AGENTS)
NUMBERS = {topic.name: number for number, topic in enumerate(TOPICS)}
CLOCK, COMMAND, EVENT = (NUMBERS[name] for name in ("/clock", "/a/cmd_vel", "/a/task_event"))


def backlog(until_ns: int = -1) -> Backlog:
    """Return a backlog of two agents."""
    return Backlog(TOPICS, AGENTS, until_ns)


def of_a(count: int) -> Expected:
    """Return a tick's counts after so many messages of the first agent."""
    return Expected(0, 0, 0, 0, (count, 0))


def test_nothing_is_handed_out_before_it_is_covered() -> None:
    """In lock step everything waits for a tick; once handed out it is gone."""
    own = backlog()
    own.take(0, CLOCK, b"0")
    assert own.hand_out() == []
    own.cover(0)
    assert own.hand_out() == [(0, CLOCK, b"0")]
    assert own.hand_out() == []


def test_what_is_later_stays() -> None:
    """A tick hands out its own time, however much has come by then."""
    own = backlog()
    for stamp_ns in (30, 10, 20):
        own.take(stamp_ns, CLOCK, b"%d" % stamp_ns)
    own.cover(20)
    assert [stamp_ns for stamp_ns, _, _ in own.hand_out()] == [10, 20]
    own.cover(30)
    assert [stamp_ns for stamp_ns, _, _ in own.hand_out()] == [30]


def test_a_later_message_stands_for_no_earlier_one() -> None:
    """A message that has overtaken another on its way isn't counted in its place."""
    own = backlog()
    own.take(10, COMMAND, b"")
    own.take(20, EVENT, b"overtook")
    own.cover(10)
    assert not own.is_complete(of_a(2))
    assert own.describe_missing(of_a(2)) == "1 of a"
    own.take(10, EVENT, b"late")
    assert own.is_complete(of_a(2))
    assert own.total == 2


def test_messages_are_in_order_of_time_and_topic() -> None:
    """In whichever order they come; those of one topic and time stay in theirs."""
    own = backlog(FOR_EVER)
    own.take(5, EVENT, b"x")
    own.take(5, EVENT, b"a")
    own.take(5, CLOCK, b"")
    own.take(1, 7, b"")
    assert own.hand_out() == [
        (1, 7, b""),
        (5, CLOCK, b""),
        (5, EVENT, b"x"),
        (5, EVENT, b"a"),
    ]
