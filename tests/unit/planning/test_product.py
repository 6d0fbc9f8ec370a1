"""The product of the small plant with automata, against a search by hand."""

import math

import numpy as np
import pytest

from support.small_plant import SmallPlant
from tlcomm_core.ltl import BuchiAutomaton, parse, translate
from tlcomm_core.planning.product import build, ticks_ns
from tlcomm_core.planning.transition_system import TransitionSystem

SYSTEM = SmallPlant().system()
FORMULAS = [
    "G F ((p & collect) & F (r & unload))",
    "F G hall & G F r",
    "X (p U (r | X m)) & G F (m & !collect)",
    "G (p -> X X r) | F G !unload",
    "false",
]


def searched(
    system: TransitionSystem, automaton: BuchiAutomaton
) -> tuple[set[tuple[int, int]], list[tuple[int, bool]]]:
    """Return the reachable pairs, and step and acceptance of every edge between them."""
    first = automaton.successors(automaton.initial, system.labels[system.initial_label])
    queue = [(0, target) for target, _ in first]
    known = set(queue)
    edges = []
    while queue:
        state, reading = queue.pop()
        for step in np.flatnonzero(system.source == state).tolist():
            letter = system.labels[system.label[step]]
            for target, accepting in automaton.successors(reading, letter):
                edges.append((step, accepting))
                pair = (int(system.target[step]), target)
                if pair not in known:
                    known.add(pair)
                    queue.append(pair)
    return known, edges


@pytest.mark.parametrize("text", FORMULAS)
def test_the_product_has_the_reachable_pairs_and_their_edges(text: str) -> None:
    """States, steps and acceptance are those that a search by hand finds."""
    automaton = translate(parse(text))
    product = build(SYSTEM, automaton)
    pairs, edges = searched(SYSTEM, automaton)
    found = zip(product.step.tolist(), product.accepting.tolist(), strict=True)
    assert product.size == len(pairs)
    assert sorted(found) == sorted(edges)


@pytest.mark.parametrize("text", FORMULAS)
def test_each_edge_leads_from_and_to_the_states_of_its_step(text: str) -> None:
    """The product's states project onto the transition system's, edge by edge."""
    product = build(SYSTEM, translate(parse(text)))
    place = np.full(product.size, -1)
    place[product.initial] = 0
    place[product.target] = SYSTEM.target[product.step]
    assert (place[product.source] == SYSTEM.source[product.step]).all()
    assert (place[product.target] == SYSTEM.target[product.step]).all()


def test_a_run_reads_the_initial_label_first() -> None:
    """Where the start is in no region, a formula that wants p at once has no product state."""
    assert build(SYSTEM, translate(parse("p"))).size == 0
    assert build(SYSTEM, translate(parse("X p"))).size > 0


def test_ticks_are_whole_nanoseconds_rounded_up() -> None:
    """Rounding noise is no nanosecond, a real remainder is one."""
    times_s = np.array([0.0, 4.0, 0.1 + 0.2, 1.0000000001, math.sqrt(2.0)])
    assert ticks_ns(times_s).tolist() == [0, 4_000_000_000, 300_000_000, 1_000_000_001, 1414213563]


def test_a_stop_on_the_way_never_saves_a_tick() -> None:
    """The ticks of a sum don't exceed the sum of the ticks."""
    one_s, other_s = np.random.default_rng(1).random((2, 10_000)) * 50.0
    assert (ticks_ns(one_s + other_s) <= ticks_ns(one_s) + ticks_ns(other_s)).all()
