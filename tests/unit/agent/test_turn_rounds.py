"""What a team that takes turns does next."""

import pytest

from support.hall import hall
from tlcomm_core.agent.charts import Charts
from tlcomm_core.agent.turn_rounds import TurnRounds
from tlcomm_core.game.algorithm import solve
from tlcomm_core.game.offer import MemberOffer, PlannedStop
from tlcomm_core.game.rules import Rules
from tlcomm_core.protocol.turns import TurnTeam
from tlcomm_core.workspace.atlas import Atlas

NAMES = ("one", "three", "two")
TEAM = TurnTeam(frozenset(NAMES), 0.96, 30.0, 0.25, rules=Rules(keeps_places=True), off_m=0.02)
GRID = hall(1).grid
ROUNDS = TurnRounds(Charts(Atlas(GRID)), TEAM, 0.0)
# Where each one's next two steps are.
STOPS_M = {"one": (0.75, 5.25), "three": (4.25, 0.75), "two": (5.25, 0.75)}


def offers_at(*xs_m: float) -> list[MemberOffer]:
    """Return the offers of the three at places in the middle of the hall."""
    return [
        MemberOffer(
            name,
            0.0,
            x_m,
            0.75,
            0.0,
            1.0,
            1.5,
            tuple(
                PlannedStop(index, stop_m, 0.75, 0.0, 20.0 * (index + 1))
                for index, stop_m in enumerate(STOPS_M[name])
            ),
        )
        for name, x_m in zip(NAMES, xs_m, strict=True)
    ]


@pytest.mark.parametrize(("round_", "leader"), [(1, "one"), (2, "three"), (3, "two"), (4, "one")])
def test_turns_go_round_by_name(round_: int, leader: str) -> None:
    """All go to where the leader's next step is, and only it does something there."""
    parts = ROUNDS.parts(round_, 5.0, offers_at(2.75, 2.75, 2.75))
    assert {part.strategy.x_m for part in parts} == {STOPS_M[leader][0]}
    assert [part.strategy.agent for part in parts if part.steps] == [leader]


def test_who_is_apart_comes_together_first() -> None:
    """Then it is nobody's turn."""
    parts = ROUNDS.parts(1, 5.0, offers_at(2.75, 3.25, 3.75))
    assert [part.strategy.x_m for part in parts] == [3.25, 3.25, 3.25]
    assert not any(part.steps for part in parts)


@pytest.mark.parametrize("xs_m", [(2.75, 2.75, 2.75), (2.25, 2.75, 4.25), (2.25, 3.0, 3.75)])
def test_there_is_nothing_to_improve(xs_m: tuple[float, float, float]) -> None:
    """A round has one team strategy, everybody's part, and that is an equilibrium."""
    offers = offers_at(*xs_m)
    problem = ROUNDS.problem(1, 5.0, offers)
    solution = solve(problem)
    parts = ROUNDS.parts(1, 5.0, offers)
    assert solution.nash == solution.initial
    assert problem.strategies(solution.nash) == tuple(part.strategy for part in parts)
