"""What an agent has heard, put together until it is published."""

from tlcomm_agent.hearing import HOLD_NS, Hearing, Hearings
from tlcomm_agent.wire import encode_hearing
from tlcomm_core.agent.radio import Heard
from tlcomm_core.protocol.messages import Confirmation, EstimateExchange, PlanOffer
from tlcomm_core.protocol.topics import TEAM_TOPICS
from tlcomm_core.records import HeardRecord
from tlcomm_msgs import msg
from tlcomm_tools.wire import read_hearing

OFFER = Heard(PlanOffer("west", 1, (), ()), 5)
CONFIRMATION = Heard(Confirmation("carrier", 1, 1, 7, ()), 6)
ESTIMATE = Heard(EstimateExchange("west", 1, 1, asks=False, value=2.0), 2**40)


def test_it_is_time_when_the_first_was_kept_long_enough() -> None:
    """Whatever came after it; and all are taken then, once."""
    kept = Hearings("east")
    assert not kept.note([], 0)
    assert not kept.note([OFFER], 10)
    assert not kept.note([CONFIRMATION], 9 + HOLD_NS)
    assert kept.note([ESTIMATE], 10 + HOLD_NS)
    heard = ((10, OFFER), (9 + HOLD_NS, CONFIRMATION), (10 + HOLD_NS, ESTIMATE))
    assert kept.take() == Hearing("east", heard)
    assert kept.take() == Hearing("east", ())
    assert not kept.note([], 10 + 2 * HOLD_NS)


def test_a_message_says_who_said_what_when_and_when_it_was_acted_upon() -> None:
    """As it is read again."""
    hearing = Hearing("east", ((10, OFFER), (11, CONFIRMATION), (2**40 + 5, ESTIMATE)))
    assert read_hearing(encode_hearing(hearing, 0), "east") == [
        HeardRecord(10, "east", "west", "plan_offer", 5),
        HeardRecord(11, "east", "carrier", "confirmation", 6),
        HeardRecord(2**40 + 5, "east", "west", "estimate_exchange", 2**40),
    ]


def test_topics_have_their_constants() -> None:
    """In the message's definition, by their names."""
    numbers = [getattr(msg.Hearing, topic.upper()) for topic in TEAM_TOPICS]
    assert numbers == list(range(len(TEAM_TOPICS)))
