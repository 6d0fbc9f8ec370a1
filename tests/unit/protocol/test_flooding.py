"""Knowledge that only grows."""

import itertools

import numpy as np
import pytest

from support.meetings import SHAPES, places
from support.snapshots import snapshot
from tlcomm_core.protocol.flooding import Flood
from tlcomm_core.world.radio import diameter, links, neighbours

TEAM = ("a", "b", "c")


def flood_of(own: str) -> Flood[str]:
    """Return a flood whose items are capital letters."""
    return Flood(TEAM, own, own.upper())


def test_it_begins_with_ones_own() -> None:
    """At first one's own item is held and nothing else; a team of one is complete."""
    flood = flood_of("b")
    assert dict(flood.held) == {"b": "B"}
    assert flood.known == ("b",)
    assert not flood.is_complete
    assert Flood(["a"], "a", 1).is_complete


def test_what_is_new_and_what_is_lacking_is_to_be_told() -> None:
    """A new item goes to all, and one's own to a sender that hasn't shown it."""
    flood = flood_of("a")
    assert flood.learn("b", ["b"], {"b": "B"}) == {"a", "b"}
    assert flood.learn("b", ["a", "b", "c"], {"c": "C"}) == {"c"}
    assert flood.is_complete


def test_what_is_on_its_way_is_not_told_again() -> None:
    """A sender that has just learned of more lacks what it will hear; one that repeats asks."""
    flood = flood_of("a")
    assert flood.learn("b", ["b"], {"b": "B"}) == {"a", "b"}
    assert flood.learn("b", ["b", "c"], {"c": "C"}) == {"c"}
    assert flood.learn("b", ["b", "c"], {"c": "C"}) == {"a"}
    assert flood.learn("b", ["b"], {}) == {"a"}


def test_hearing_the_same_twice_changes_nothing() -> None:
    """A repetition that shows nothing new, of a sender that lacks nothing, has no effect."""
    flood = flood_of("a")
    flood.learn("b", ["a", "b"], {"b": "B"})
    before = snapshot(flood)
    assert flood.learn("b", ["b"], {"b": "B"}) is None
    assert snapshot(flood) == before


def test_the_first_version_stays() -> None:
    """An item held already is never replaced, one's own included."""
    flood = flood_of("a")
    flood.learn("b", ["b"], {"b": "B"})
    flood.learn("c", TEAM, {"a": "?", "b": "?", "c": "C"})
    assert dict(flood.held) == {"a": "A", "b": "B", "c": "C"}


def test_what_was_shown_is_not_forgotten() -> None:
    """A message that was overtaken by a later one takes nothing back."""
    flood = flood_of("a")
    flood.learn("b", TEAM, {})
    flood.learn("b", ["b"], {"b": "B"})
    assert flood.lacking("b") == frozenset()
    assert flood.is_shown_complete_by(["b"])
    assert not flood.is_shown_complete_by(["b", "c"])


def test_lacking_is_what_a_neighbour_has_not_shown() -> None:
    """A neighbour never heard lacks everything; several lack what any of them does."""
    flood = flood_of("a")
    flood.learn("b", ["a", "b"], {"b": "B"})
    assert flood.lacking("c") == {"a", "b"}
    assert flood.lacking("b") == frozenset()
    assert flood.lacking("b", "c") == {"a", "b"}
    assert flood.lacking_anywhere() == frozenset()
    assert flood.lacking() == frozenset()


def test_any_order_ends_the_same() -> None:
    """All orders and repetitions of the same messages give the same knowledge."""
    said = [("b", ["b"], {"b": "B"}), ("c", ["b", "c"], {"c": "C"}), ("c", ["c"], {"c": "C"})]
    ends = set()
    for order in itertools.permutations([*said, said[0]]):
        flood = flood_of("a")
        for message in order:
            flood.learn(*message)
        ends.add((flood.known, flood.lacking("b"), flood.lacking("c"), flood.is_complete))
    assert len(ends) == 1


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("count", [2, 5, 8])
def test_it_is_complete_after_as_many_exchanges_as_the_diameter(shape: str, count: int) -> None:
    """Synchronous exchanges of all that is held reach everyone in exactly D steps."""
    at_m = np.array(places(shape, count, np.random.default_rng(count)))
    pairs = links(at_m, 0.96)
    hops = diameter(count, pairs)
    assert hops is not None
    floods = [Flood(map(str, range(count)), str(agent), agent) for agent in range(count)]
    exchanges = 0
    while not all(flood.is_complete for flood in floods):
        told = [dict(flood.held) for flood in floods]
        for agent, nodes in enumerate(neighbours(count, pairs)):
            for node in nodes:
                floods[agent].learn(str(node), told[node], told[node])
        exchanges += 1
    assert exchanges == hops
