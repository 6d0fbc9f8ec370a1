"""Which attempts at actions fail."""

import numpy as np
import pytest

from tlcomm_core.agent.faults import ActionFaults, fault_rng

COUNT = 2000


def strikes(probability: float, seed: int = 0, agent: str = "one") -> list[bool]:
    """Return what befalls the first attempts."""
    faults = ActionFaults(probability, fault_rng(seed, agent))
    return [faults.strikes() for _ in range(COUNT)]


@pytest.mark.parametrize("probability", [0.0, 0.1, 0.5, 1.0])
def test_the_share_of_failures_is_the_probability(probability: float) -> None:
    """Within four standard deviations; never and always are exact."""
    slack = 4.0 * np.sqrt(COUNT * probability * (1.0 - probability))
    assert abs(sum(strikes(probability)) - COUNT * probability) <= slack


def test_seed_and_name_decide() -> None:
    """The same of both give the same, another of either something else."""
    assert strikes(0.5, 3, "one") == strikes(0.5, 3, "one")
    assert len({tuple(strikes(0.5, *own)) for own in [(3, "one"), (4, "one"), (3, "two")]}) == 3


def test_what_cannot_fail_draws_nothing() -> None:
    """Its generator stays as it was."""
    rng = np.random.default_rng(0)
    ActionFaults(0.0, rng).strikes()
    assert rng.random() == np.random.default_rng(0).random()
