"""The generator's arguments."""

import numpy as np
import pytest

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.scenario.generator import random_scenario


def test_the_seed_decides_everything() -> None:
    """The same seed gives the same scenario, another a different one."""
    one, same, other = (random_scenario(np.random.default_rng(s), 5) for s in (1, 1, 2))
    assert one == same
    assert one != other


def test_a_team_that_doesnt_fit_is_refused() -> None:
    """More agents than free cells can't start."""
    with pytest.raises(LocalMisuseError, match="don't fit"):
        random_scenario(np.random.default_rng(0), 50, size_m=(3.0, 3.0))
