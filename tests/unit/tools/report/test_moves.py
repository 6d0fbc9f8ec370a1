"""The moves by which a round's cost came down."""

from dataclasses import replace

import pytest

from support.command import CORRIDOR
from tlcomm_core.game.solver import BEST_RESPONSE
from tlcomm_core.mission import Mission
from tlcomm_core.protocol.messages import BestResponse, TeamMessage
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate
from tlcomm_tools.report.moves import courses


def test_moves_lead_from_the_first_strategy_to_the_agreed_one() -> None:
    """Φ comes down by each move to what was agreed on; what is recorded in part isn't told."""
    heard: list[TeamMessage] = []
    site = Site.from_scenario(load_scenario(CORRIDOR))
    left = simulate(Mission(site, 0, 3, None, BEST_RESPONSE), on_message=heard.append)
    said = [message for message in heard if isinstance(message, BestResponse)]
    course_of = courses(said)
    agreed = {own.strategy for own in left.records.strategies if own.strategy.iteration}
    assert agreed
    for strategy in agreed:
        moves = course_of[strategy.round].moves_to(strategy)
        assert moves
        assert len(moves) == strategy.iteration
        course_s = [strategy.initial_potential_s, *(own["potential_s"] for own in moves)]
        assert course_s == sorted(course_s, reverse=True)
        first_s = moves[0]["potential_s"] - moves[0]["change_s"]
        assert first_s == pytest.approx(strategy.initial_potential_s, abs=2e-3)
        assert course_s[-1] == pytest.approx(strategy.potential_s, abs=1e-3)
        first = replace(said[0], change_s=0.0)
        assert courses([first])[first.round].moves_to(replace(strategy, iteration=9)) is None
