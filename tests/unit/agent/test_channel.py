"""Loss, delay, duplication and bandwidth between two agents."""

from itertools import pairwise

import pytest

from tlcomm_core.agent.channel import CONGESTED, LOST, Channel, Passage
from tlcomm_core.protocol.messages import Confirmation, Message
from tlcomm_core.protocol.size import size_bytes
from tlcomm_core.scenario.model import Radio

RANGE_M = 2.0
STEP_NS = 1_000_000
COUNT = 10_000
HELLO = Confirmation("a", 1, 0, 7, ("a", "b"))


def channel(receiver: str = "b", seed: int = 1, **radio: float) -> Channel:
    """Return a channel to an agent."""
    return Channel(Radio(**radio), RANGE_M, seed, receiver)


def passages(
    made: Channel, message: Message = HELLO, distance_m: float = 1.0, count: int = COUNT
) -> list[Passage]:
    """Return what becomes of a message repeated every millisecond."""
    return [made.carry(message, STEP_NS * n, distance_m) for n in range(count)]


def share(made: Channel, reason: str, distance_m: float) -> float:
    """Return the share of messages that something befalls."""
    found = passages(made, distance_m=distance_m)
    return sum(passage.obstacle == reason for passage in found) / COUNT


def test_a_perfect_channel_lets_everything_through_at_once() -> None:
    """Once each, at any distance."""
    assert set(passages(channel(), distance_m=RANGE_M)) == {Passage((0,))}


@pytest.mark.parametrize(
    ("radio", "distance_m", "expected"),
    [
        ({"loss": 0.3}, 0.0, 0.3),
        ({"loss": 0.3}, RANGE_M, 0.3),
        ({"loss_at_range": 0.4}, 0.0, 0.0),
        ({"loss_at_range": 0.4}, 1.0, 0.2),
        ({"loss": 0.1, "loss_at_range": 0.5}, 1.5, 0.4),
        ({"loss": 0.5, "loss_at_range": 0.1}, RANGE_M, 0.1),
        ({"loss": 1.0}, 1.0, 1.0),
    ],
)
def test_loss_is_linear_in_the_distance(
    radio: dict[str, float], distance_m: float, expected: float
) -> None:
    """From ``loss`` at 0 to ``loss_at_range`` at R, within three standard deviations."""
    tolerance = 3.0 * (expected * (1.0 - expected) / COUNT) ** 0.5
    assert share(channel(**radio), LOST, distance_m) == pytest.approx(expected, abs=tolerance)


def test_what_is_lost_is_not_heard() -> None:
    """It has a reason and no delays; what is heard has delays and no reason."""
    found = passages(channel(loss=0.5, duplication=0.5))
    assert {(passage.obstacle, len(passage.delays_ns)) for passage in found} == {
        (LOST, 0), ("", 1), ("", 2),
    }  # fmt: skip


def test_jitter_is_uniform() -> None:
    """From 0 to the given time, with the mean and the spread of a uniform delay."""
    delays_s = [passage.delays_ns[0] * 1e-9 for passage in passages(channel(jitter_s=0.05))]
    assert 0.0 <= min(delays_s) < 0.001
    assert 0.049 < max(delays_s) <= 0.05
    mean_s = sum(delays_s) / COUNT
    assert mean_s == pytest.approx(0.025, abs=3.0 * 0.05 / (12.0 * COUNT) ** 0.5)
    variance = sum((delay_s - mean_s) ** 2 for delay_s in delays_s) / COUNT
    assert variance == pytest.approx(0.05**2 / 12.0, rel=0.05)


def test_copies_have_delays_of_their_own() -> None:
    """The stated share of messages is heard twice, seldom at the same instant."""
    found = passages(channel(duplication=0.2, jitter_s=0.05))
    doubled = [passage.delays_ns for passage in found if len(passage.delays_ns) > 1]
    assert len(doubled) / COUNT == pytest.approx(0.2, abs=0.012)
    assert sum(first == second for first, second in doubled) < 3


def test_one_effect_does_not_sway_another() -> None:
    """Messages that are heard twice are as late as others."""
    found = passages(channel(duplication=0.5, jitter_s=0.05))
    late_s = [p.delays_ns[0] * 1e-9 for p in found if len(p.delays_ns) > 1]
    assert sum(late_s) / len(late_s) == pytest.approx(0.025, abs=0.0008)


def test_a_fate_is_the_messages_own() -> None:
    """Neither order nor what else was carried changes it."""
    radio = {"loss": 0.4, "jitter_s": 0.05, "duplication": 0.3}
    forth = passages(channel(**radio), count=200)
    back_channel = channel(**radio)
    back = [back_channel.carry(HELLO, STEP_NS * n, 1.0) for n in reversed(range(200))]
    assert forth == back[::-1]


@pytest.mark.parametrize(
    "other",
    [
        passages(channel("c", loss=0.5), count=200),
        passages(channel(seed=2, loss=0.5), count=200),
        passages(channel(loss=0.5), Confirmation("c", 1, 0, 7, ("a", "b")), count=200),
        passages(channel(loss=0.5), Confirmation("a", 1, 1, 7, ("a", "b")), count=200),
        passages(channel(loss=0.5), Confirmation("a", 1, 0, 7, ("a", "c")), count=200),
    ],
)
def test_other_links_seeds_and_messages_have_other_fates(other: list[Passage]) -> None:
    """Half of them agree by chance."""
    same = sum(one == two for one, two in zip(passages(channel(loss=0.5)), other, strict=False))
    assert 70 < same < 130


def test_fates_never_change() -> None:
    """What a seed stands for is the same on every machine and in every version."""
    made = channel(loss=0.3, jitter_s=0.05, duplication=0.3)
    assert [passage.delays_ns for passage in passages(made, count=6)] == [
        (), (), (26109488,), (25190312, 14776744), (15927333,), (15808015,),
    ]  # fmt: skip


def test_messages_wait_for_those_before() -> None:
    """On one link, one after the other, each as long as its bits take; other links are free."""
    bits = 8 * size_bytes(HELLO)
    made = channel(bandwidth_bps=1000.0 * bits)
    delays_ns = [made.carry(HELLO, 0, 1.0).delays_ns for _ in range(3)]
    assert delays_ns == [(1_000_000,), (2_000_000,), (3_000_000,)]
    assert made.carry(Confirmation("c", 1, 0, 7, ("a", "b")), 0, 1.0).delays_ns == (1_000_000,)
    assert made.carry(HELLO, 2_500_000, 1.0).delays_ns == (1_500_000,)
    assert made.carry(HELLO, 9_000_000, 1.0).delays_ns == (1_000_000,)


def test_a_message_that_would_wait_too_long_is_dropped() -> None:
    """More than a second behind; a lone one takes the time that it takes."""
    made = channel(bandwidth_bps=8.0 * size_bytes(HELLO) / 0.6)
    found = [made.carry(HELLO, 0, 1.0) for _ in range(3)]
    assert found == [Passage((600_000_000,)), Passage((1_200_000_000,)), Passage((), CONGESTED)]
    slow = channel(bandwidth_bps=8.0 * size_bytes(HELLO) / 60.0)
    assert slow.carry(HELLO, 0, 1.0) == Passage((60_000_000_000,))


def test_what_is_lost_takes_its_time_on_the_air() -> None:
    """Loss comes after sending, so others wait for it all the same."""
    made = channel(bandwidth_bps=8000.0 * size_bytes(HELLO), loss=0.5)
    found = [made.carry(HELLO, n, 1.0) for n in range(20)]
    assert {passage.obstacle for passage in found} == {"", LOST}
    heard_ns = [n + p.delays_ns[0] for n, p in enumerate(found) if p.delays_ns]
    assert heard_ns == [(n + 1) * 1_000_000 for n, p in enumerate(found) if p.delays_ns]
    assert all(one < two for one, two in pairwise(heard_ns))
