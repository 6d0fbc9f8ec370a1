"""Maps that change at random while a team is about its tasks."""

from collections import defaultdict

import pytest

from support.changing_hall import changing_hall
from tlcomm_core.mission import Mission
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate

END_S = 200.0


@pytest.mark.parametrize("seed", range(6))
def test_nobody_runs_into_anything_and_all_agree(seed: int) -> None:
    """Wherever agents are when cells close, even round them."""
    left = simulate(Mission(Site.from_scenario(changing_hall(seed)), seed, None, END_S))
    assert left.collisions == {"one": 0, "two": 0}
    held = defaultdict(set)
    for record in left.records.strategies:
        held[record.strategy.round].add(record.strategy)
    assert len(held) >= 4
    assert all(len(strategies) == 1 for strategies in held.values())
