"""Teams that agree on the next turn, over good networks and bad ones."""

import pytest

from support.fake_network import FakeNetwork, Faults
from tlcomm_core.agent.charts import Charts
from tlcomm_core.agent.turn_rounds import TurnRounds
from tlcomm_core.game.offer import MemberOffer, PlannedStop
from tlcomm_core.game.rules import Rules
from tlcomm_core.protocol.actions import HoldStrategy
from tlcomm_core.protocol.turns import TurnTeam, pause_s
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.grid import Grid

GRID = Grid((8.0, 2.0), 0.5)
ARRIVAL_S = 500.0
LEADER_S = 4.0
BAD = Faults(loss=0.3, jitter_s=0.02, duplication=0.2)


def offer_of(index: int, x_m: float, arrival_s: float) -> MemberOffer:
    """Return an agent's offer; its next step is 0.5 m further than its predecessor's."""
    stops = tuple(
        PlannedStop(step, 0.75 + 0.5 * index, 1.25, 0.0, 30.0 * (step + 1)) for step in range(2)
    )
    return MemberOffer(f"agent_{index}", arrival_s, x_m, 0.75, 0.3 * index, 1.0, 1.5, stops)


def network_of(count: int, seed: int, faults: Faults, spacing_m: float = 0.0) -> FakeNetwork:
    """Return a team at a place, or in a line, whose last leader comes later, when it has acted."""
    members = frozenset(f"agent_{index}" for index in range(count))
    team = TurnTeam(members, 0.96, 30.0, 0.25, rules=Rules(keeps_places=True), off_m=0.02)
    offers = [
        offer_of(index, 2.25 + spacing_m * index, ARRIVAL_S + LEADER_S * (index == seed % count))
        for index in range(count)
    ]
    rounds = TurnRounds(Charts(Atlas(GRID)), team, 0.0)
    return FakeNetwork(tuple(offers), 1000 + seed, team, rounds, faults, seed)


def assert_agreed(network: FakeNetwork) -> None:
    """Check that all hold everybody's part as the offers make it, and nothing else."""
    assert network.is_agreed
    assert isinstance(network.rounds, TurnRounds)
    begins_s = network.begins_s + network.team.duration_s
    parts = network.rounds.parts(network.round, begins_s, network.offers)
    held = [e.action.strategy for e in network.transcript if isinstance(e.action, HoldStrategy)]
    assert len(held) == len(network.offers)
    assert {own.strategies for own in held} == {tuple(part.strategy for part in parts)}
    assert {own.iteration for own in held} == {0}


@pytest.mark.parametrize("count", range(1, 9))
def test_a_turn_is_agreed_on_within_the_pause(count: int) -> None:
    """All know it long before they are to leave together, on a good network."""
    network = network_of(count, 1, Faults())
    network.run_until_agreed(0.25)
    assert_agreed(network)
    assert max(network.agreed_s.values()) < network.begins_s + 0.1


@pytest.mark.parametrize("count", [2, 5, 8])
def test_losses_delay_no_longer_than_the_pause_that_they_ask_for(count: int) -> None:
    """Nobody agrees on anything else, either."""
    for seed in range(8):
        network = network_of(count, seed, BAD)
        allowed_s = pause_s(network.team, BAD.latency_s, BAD.jitter_s, BAD.loss)
        network.run_until_agreed(allowed_s)
        assert_agreed(network)


@pytest.mark.parametrize("seed", range(4))
def test_a_line_agrees_to_contract(seed: int) -> None:
    """Also where not everybody hears everybody."""
    network = network_of(6, seed, BAD, spacing_m=0.9)
    network.run_until_agreed(20.0)
    assert_agreed(network)
    places_m = {own.x_m for own in network.agents["agent_0"].agreed.strategies}  # type: ignore[union-attr]
    assert len(places_m) < 6


def test_nobody_gives_a_turn_up() -> None:
    """However long somebody isn't heard: after hours, it goes on as if nothing had been."""
    network = network_of(3, 0, Faults())
    network.is_cut = lambda _time_s, _receiver, message: message.sender == "agent_2"
    network.run(network.begins_s + 3600.0)
    assert not network.is_agreed
    network.is_cut = lambda _time_s, _receiver, _message: False
    network.run_until_agreed(3610.0)
    assert_agreed(network)
