"""Whether agreed places are as the scenario demands."""

import pytest

from support.hand_made_run import hand_made_scenario
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.records import StrategyRecord
from tlcomm_tools.audit.meetings import audit_meetings

# The scenario's range is 1 m.
ROW = ((0.0, 0.0), (0.75, 0.0), (1.5, 0.0))
TRIANGLE = ((0.0, 0.0), (0.75, 0.0), (0.5, 0.5))


def found(places_m: tuple[tuple[float, float], ...], **demands: float) -> list[str]:
    """Return what is wrong with a meeting that two agents hold alike."""
    scenario = hand_made_scenario()
    communication = scenario.communication.model_copy(update=demands)
    strategies = tuple(
        Strategy(f"agent_{index}", x_m, y_m, 0, 60.0, 0.0)
        for index, (x_m, y_m) in enumerate(places_m)
    )
    held = TeamStrategy(4, 0, strategies, 60.0, 0.0, 0.0)
    records = [StrategyRecord(1, own.agent, held) for own in strategies[:2]]
    return [*audit_meetings(scenario.model_copy(update={"communication": communication}), records)]


@pytest.mark.parametrize("places_m", [ROW, TRIANGLE, (ROW[0], ROW[0])])
def test_without_demands_all_places_will_do(places_m: tuple[tuple[float, float], ...]) -> None:
    """As in the paper."""
    assert found(places_m) == []


def test_places_too_close_are_named_once() -> None:
    """However many hold the strategy."""
    assert found(TRIANGLE, separation_m=0.56) == [
        "round 4: agent_1 and agent_2 meet 0.559 m apart, not 0.56 m"
    ]
    assert found(TRIANGLE, separation_m=0.55) == []


def test_whoever_holds_others_together_alone_is_named() -> None:
    """The middle of a row; nobody in a triangle, nor of two."""
    assert found(ROW, resilience=1) == ["round 4: without agent_1 the others would be apart"]
    assert found(TRIANGLE, resilience=1) == []
    assert found(ROW[:2], resilience=1) == []
