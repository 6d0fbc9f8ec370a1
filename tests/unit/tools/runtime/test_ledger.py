"""Tests of ``tlcomm_tools.runtime.ledger``."""

import pytest

from tlcomm_tools.bag.topics import recorded_topics
from tlcomm_tools.runtime.ledger import Expected, Ledger

TOPICS = recorded_topics(("east", "west"), measures=True)
NUMBERS = {topic.name: number for number, topic in enumerate(TOPICS)}


def test_a_new_ledger_is_complete_for_nothing() -> None:
    """Nothing is missing when nothing was published."""
    ledger = Ledger(TOPICS, ("east", "west"))
    assert ledger.is_complete(Expected(0, 0, 0, 0, (0, 0)))
    assert not ledger.is_complete(Expected(1, 0, 0, 0, (0, 0)))


@pytest.mark.parametrize(
    ("topic", "expected"),
    [
        ("/clock", Expected(0, 0, 1, 0, (0, 0))),
        ("/map", Expected(0, 0, 0, 1, (0, 0))),
        ("/connectivity", Expected(0, 1, 0, 0, (0, 0))),
        ("/east/odom", Expected(1, 0, 0, 0, (0, 0))),
        ("/west/odom", Expected(1, 0, 0, 0, (0, 0))),
        ("/east/cmd_vel", Expected(0, 0, 0, 0, (1, 0))),
        ("/west/team_strategy", Expected(0, 0, 0, 0, (0, 1))),
        ("/west/estimate", Expected(0, 0, 0, 0, (0, 1))),
        ("/west/estimate_exchange", Expected(0, 0, 0, 0, (0, 1))),
        ("/west/reading", Expected(0, 0, 0, 0, (0, 0), readings=1)),
    ],
)
def test_each_topic_counts_for_its_publisher(topic: str, expected: Expected) -> None:
    """Odometry is the world's, whoever's it is; all else in a namespace is the agent's."""
    ledger = Ledger(TOPICS, ("east", "west"))
    ledger.count(NUMBERS[topic])
    assert ledger.is_complete(expected)
    assert ledger.total == 1


def test_too_much_of_one_is_not_enough_of_another() -> None:
    """One publisher's messages don't make up for another's, and what lacks is named."""
    ledger = Ledger(TOPICS, ("east", "west"))
    for _ in range(3):
        ledger.count(NUMBERS["/east/cmd_vel"])
    expected = Expected(2, 0, 0, 0, (1, 2))
    assert not ledger.is_complete(expected)
    assert ledger.describe_missing(expected) == "2 of odometry, 2 of west"
