"""What exchanging estimates does to a whole team, on whatever graph."""

from itertools import combinations, pairwise
from zlib import crc32

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from support.estimating_team import EstimatingTeam
from tlcomm_core.agent.averaging import Consensus, Exact

NAMES = "abcdefgh"
TOLERANCE = 0.01
Edges = list[tuple[str, str]]


@st.composite
def teams(draw: st.DrawFn) -> tuple[str, Edges, dict[str, float]]:
    """Draw some names, links that connect them, and their readings."""
    names = NAMES[: draw(st.integers(2, 8))]
    tree = [(names[draw(st.integers(0, i - 1))], name) for i, name in enumerate(names) if i]
    pairs = [pair for pair in combinations(names, 2) if pair not in tree]
    more = draw(st.lists(st.sampled_from(pairs), unique=True)) if pairs else []
    readings = {name: draw(st.floats(-100.0, 100.0)) for name in names}
    return names, [*tree, *more], readings


def consensus(own: str) -> Consensus:
    """Return a member's part in a consensus with steps of its own choice."""
    return Consensus(own, None, TOLERANCE)


def diameter(edges: Edges) -> int:
    """Return the most hops between two members."""
    return int(nx.diameter(nx.Graph(edges)))


@given(teams(), st.booleans())
def test_consensus_keeps_the_average_and_comes_to_rest(
    case: tuple[str, Edges, dict[str, float]], is_given: bool
) -> None:
    """Neighbours agree to the tolerance then, with a given step below 1/(N − 1) or without."""
    names, edges, readings = case
    step = 0.99 / (len(names) - 1) if is_given else None
    team = EstimatingTeam(names, lambda own: Consensus(own, step, TOLERANCE))
    team.read(readings)
    team.link(edges)
    team.run()
    values = team.values
    assert team.asked == 0
    assert sum(values.values()) == pytest.approx(sum(readings.values()), abs=1e-9)
    assert all(abs(values[i] - values[j]) <= TOLERANCE for i, j in edges)
    spread = max(values.values()) - min(values.values())
    assert spread <= diameter(edges) * TOLERANCE + 1e-12


@given(teams(), st.lists(st.sets(st.sampled_from(sorted(combinations(NAMES, 2)))), max_size=5))
def test_links_that_come_and_go_keep_the_average(
    case: tuple[str, Edges, dict[str, float]], changes: list[set[tuple[str, str]]]
) -> None:
    """At whatever moment; while nothing is lost, both ends of a link reckon with the same."""
    names, edges, readings = case
    team = EstimatingTeam(names, consensus)
    team.read(readings)
    team.link(edges)
    for change in changes:
        team.exchange()
        team.exchange()
        team.link([pair for pair in change if set(pair) <= set(names)])
    team.run()
    assert team.asked == 0
    assert sum(team.values.values()) == pytest.approx(sum(readings.values()), abs=1e-9)


@given(teams(), st.lists(st.tuples(st.integers(0, 7), st.floats(-100.0, 100.0)), max_size=12))
def test_the_average_is_that_of_the_newest_readings(
    case: tuple[str, Edges, dict[str, float]], later: list[tuple[int, float]]
) -> None:
    """Whenever members measure, before they have heard of the field or after."""
    names, edges, readings = case
    team = EstimatingTeam(names, consensus)
    team.link(edges)
    newest: dict[str, float] = {}
    for number, value in (*later, *enumerate(readings.values())):
        name = names[number % len(names)]
        newest[name] = value
        team.read({name: value})
        team.exchange()
        team.exchange()
    team.run()
    assert sum(team.values.values()) == pytest.approx(sum(newest.values()), abs=1e-9)


@given(teams(), st.integers(0, 1000))
def test_with_losses_estimates_stay_among_the_readings_and_come_together(
    case: tuple[str, Edges, dict[str, float]], seed: int
) -> None:
    """The average may shift, but never beyond what was measured; and all come to rest."""
    names, edges, readings = case

    def is_heard(step: int, sender: str, receiver: str) -> bool:
        # Who hears nothing of each other at first agrees on nothing.
        chance = crc32(f"{seed}/{step}/{sender}/{receiver}".encode()) / 2**32
        return step <= 1 or chance > 0.3

    team = EstimatingTeam(names, consensus, is_heard)
    team.read(readings)
    team.link(edges)
    team.run()
    least, most = min(readings.values()), max(readings.values())
    for values in team.history.values():
        assert all(least - 1e-9 <= value <= most + 1e-9 for value in values)


@given(teams())
def test_flooding_gives_everybody_the_same_average(
    case: tuple[str, Edges, dict[str, float]],
) -> None:
    """After as many exchanges as the graph's diameter, one to begin with and one to hear."""
    names, edges, readings = case
    team = EstimatingTeam(names, Exact)
    team.read(readings)
    team.link(edges)
    assert team.run() <= diameter(edges) + 2
    assert len(set(team.values.values())) == 1
    assert team.values[names[0]] == pytest.approx(np.mean(list(readings.values())))


def test_a_step_beyond_the_bound_diverges() -> None:
    """On a ring of even length, Δ = 2, the values alternate and grow with ε > 1/2."""
    team = EstimatingTeam("abcd", lambda own: Consensus(own, 0.6, TOLERANCE))
    team.read({"a": 1.0, "b": -1.0, "c": 1.0, "d": -1.0})
    team.link([*pairwise("abcd"), ("d", "a")])
    for _ in range(20):
        team.exchange()
    assert max(map(abs, team.values.values())) > 10.0
