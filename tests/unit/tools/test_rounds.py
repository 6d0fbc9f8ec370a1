"""Round problems as the team poses them."""

import numpy as np
import pytest

from support.command import CORRIDOR
from tlcomm_core.errors import InputError
from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.site import Site
from tlcomm_tools.rounds import _Poser, pose_first_round, pose_round, pose_rounds


@pytest.fixture(scope="module")
def site() -> Site:
    """Return a small scenario."""
    return Site.from_scenario(load_scenario(CORRIDOR))


def is_same(one: RoundProblem, other: RoundProblem) -> bool:
    """Tell whether two problems have the same window and candidates."""
    return one.window_s == other.window_s and all(
        own.agent == peer.agent
        and np.array_equal(own.arrival_s, peer.arrival_s)
        and np.array_equal(own.extra_s, peer.extra_s)
        for own, peer in zip(one.candidates, other.candidates, strict=True)
    )


def test_rounds_posed_together_are_those_posed_alone(site: Site) -> None:
    """One simulation shows all of them; no two are the same."""
    together = pose_rounds(site, 3, seed=0)
    assert [problem.round for problem in together] == [1, 2, 3]
    for problem in together:
        assert is_same(problem, pose_round(site, problem.round, seed=0))
    assert not is_same(together[0], together[1])


def test_the_first_round_needs_no_simulation(site: Site) -> None:
    """What the agents say where they start poses it."""
    assert is_same(pose_first_round(site), pose_round(site, 1, seed=0))


def test_a_round_that_lacks_an_offer_is_told(site: Site) -> None:
    """By its number and the agents that are missing."""
    missing = ", ".join(site.scenario.agents)
    with pytest.raises(InputError, match=f"round 7 is never planned.* lacks {missing}"):
        _Poser(site).problem(7, {})
