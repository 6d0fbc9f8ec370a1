"""What one exchange does to one agent's estimate."""

from collections.abc import Sequence

import pytest

from tlcomm_core.agent.averaging import Consensus, Exact
from tlcomm_core.protocol.messages import EstimateExchange, Measurement


def word(sender: str, value: float, neighbours: int = 1) -> EstimateExchange:
    """Return what somebody says."""
    return EstimateExchange(sender, 0, neighbours, False, value)


def stepped(
    step: float | None, own: EstimateExchange, heard: Sequence[EstimateExchange]
) -> float | None:
    """Return a consensus's estimate after one exchange."""
    consensus = Consensus("a", step, 0.01)
    consensus.measure(own.value, 0)
    consensus.exchange(own, heard)
    return consensus.estimate


def test_two_alone_meet_in_the_middle() -> None:
    """Each has one neighbour: ε = 1/2."""
    assert stepped(None, word("a", 10.0), [word("b", 20.0)]) == 15.0
    assert stepped(None, word("b", 20.0), [word("a", 10.0)]) == 15.0


def test_the_end_with_more_neighbours_decides_on_the_step() -> None:
    """1 / (1 + max), the same at both ends; so what one gains the other loses."""
    assert stepped(None, word("a", 10.0, 1), [word("b", 18.0, 3)]) == 12.0
    assert stepped(None, word("b", 18.0, 3), [word("a", 10.0, 1)]) == 16.0


def test_a_given_step_is_taken() -> None:
    """ε times the sum of all differences."""
    assert stepped(0.125, word("a", 10.0, 3), [word("b", 18.0), word("c", 2.0, 7)]) == 10.0
    assert stepped(0.125, word("a", 10.0), [word("b", 18.0), word("c", 10.0)]) == 11.0


def test_a_difference_within_the_tolerance_counts_as_none() -> None:
    """So the exchange comes to rest."""
    near, far = word("b", 10.01), word("b", 10.02)
    assert stepped(None, word("a", 10.0), [near]) == 10.0
    consensus = Consensus("a", None, 0.0100001)
    assert not consensus.moving(word("a", 10.0), [near])
    assert consensus.moving(word("a", 10.0), [near, far])


def test_the_order_of_neighbours_doesn_t_matter() -> None:
    """Not even for the last bit."""
    heard = [word(name, 10.0 + 0.1 * 3.7**k) for k, name in enumerate("bcdefg")]
    own = word("a", 10.3, 6)
    assert stepped(None, own, heard) == stepped(None, own, heard[::-1])


def test_an_agent_without_a_value_takes_the_mean_of_what_it_hears() -> None:
    """And has nothing to step from before."""
    consensus = Consensus("a", None, 0.01)
    assert consensus.estimate is None
    assert not consensus.moving(None, [])
    consensus.exchange(None, [])
    assert consensus.estimate is None
    assert consensus.moving(None, [word("b", 10.0)])
    consensus.exchange(None, [word("b", 10.0), word("c", 14.0)])
    assert consensus.estimate == 12.0


def test_a_measurement_shifts_the_estimate_by_what_it_has_changed() -> None:
    """Whatever was agreed on before stays."""
    consensus = Consensus("a", None, 0.01)
    consensus.measure(10.0, 0)
    consensus.exchange(word("a", 10.0), [word("b", 20.0)])
    agreed = consensus.estimate
    assert agreed is not None
    consensus.measure(30.0, 1)
    assert consensus.estimate == agreed + 20.0
    assert consensus.known == ()


def test_the_first_measurement_replaces_what_was_taken_over() -> None:
    """Until then the estimate was others' alone, and counts once already."""
    consensus = Consensus("a", None, 0.01)
    consensus.exchange(None, [word("b", 20.0)])
    consensus.measure(10.0, 0)
    assert consensus.estimate == 10.0


def test_the_exact_average_is_of_the_newest_measurements() -> None:
    """An older one of the same member changes nothing; its own nobody else knows better."""
    exact = Exact("a")
    assert exact.estimate is None
    exact.measure(10.0, 5)
    old = (Measurement("a", 99.0, 9), Measurement("b", 20.0, 3))
    new = (Measurement("b", 40.0, 4), Measurement("c", 70.0, 1))
    heard = [EstimateExchange("b", 0, 1, False, 0.0, known) for known in (new, old)]
    assert exact.moving(None, heard)
    exact.exchange(None, heard)
    assert exact.known == (Measurement("a", 10.0, 5), *new)
    assert exact.estimate == 40.0
    assert not exact.moving(None, heard)


@pytest.mark.parametrize("averaging", [Consensus("a", None, 0.01), Exact("a")])
def test_what_an_agent_measures_alone_is_its_estimate(averaging: Consensus | Exact) -> None:
    """In both ways."""
    averaging.measure(7.0, 3)
    assert averaging.estimate == 7.0
