"""Which places are linked."""

import numpy as np
import pytest

from tlcomm_core.game.links import LINK_TOLERANCE_M, Links, within_range

LINE_M = np.array([[0.0, 0.0], [1.0, 0.0], [3.0, 0.0], [4.0, 0.0]])
LINE = Links(LINE_M, 1.0)


def test_range_is_closed_and_forgives_rounding() -> None:
    """A distance of R, or R and half the tolerance, is a link; R and twice it is none."""
    over_m = LINK_TOLERANCE_M * np.array([0.0, 0.5, 2.0])
    places_m = np.column_stack((1.0 + over_m, np.zeros(3)))
    assert within_range(np.zeros((1, 2)), places_m, 1.0).tolist() == [[True, True, False]]


def test_a_place_is_near_itself_and_what_is_in_range() -> None:
    """The ends of the line know each other's neighbour not."""
    assert [LINE.near(place).tolist() for place in range(4)] == [[0, 1], [0, 1], [2, 3], [2, 3]]


def test_components_split_a_line_at_its_gap() -> None:
    """Places 0–1 and 3–4 m on a line are two components at 1 m, one at 2 m."""
    assert set(LINE.components([3, 1, 0, 2, 1])) == {frozenset({0, 1}), frozenset({2, 3})}
    assert len(Links(LINE_M, 2.0).components(range(4))) == 1


def test_a_long_chain_is_one_component() -> None:
    """Connection passes through any number of links, in any order of the places."""
    chain_m = np.column_stack((np.arange(30.0), np.zeros(30)))
    links = Links(np.random.default_rng(1).permutation(chain_m), 1.0)
    middle = links.place_at(15.0, 0.0)
    assert links.is_connected(range(30))
    assert not links.is_connected([place for place in range(30) if place != middle])


@pytest.mark.parametrize("count", [0, 1])
def test_nobody_and_a_single_place_are_connected(count: int) -> None:
    """A graph with less than two nodes has nothing to disconnect."""
    assert Links(LINE_M, 0.1).is_connected(range(count))


def test_a_connecting_place_touches_every_component() -> None:
    """Only the middle of a gap joins both parts; at one side the team stays apart."""
    links = Links(np.vstack((LINE_M, [[0.5, 0.0], [2.0, 0.0], [2.0, 0.5], [3.5, 0.0]])), 1.0)
    assert np.flatnonzero(links.connecting([0, 1, 2, 3])).tolist() == [5]


def test_an_agent_alone_may_go_anywhere() -> None:
    """Without others every place keeps the team connected."""
    assert LINE.connecting([]).all()


def test_what_is_out_of_sight_is_not_linked() -> None:
    """A wall between 0 and 1 m leaves each place itself, and takes that link from the table."""
    west = np.array([True, False, False, False])
    links = Links(LINE_M, 1.0, sight=lambda place, others: west[place] == west[others])
    assert links.near(0).tolist() == [0]
    assert not links.is_connected([0, 1])
    assert links.connecting([0]).tolist() == west.tolist()
    near = [set(links.neighbourhood.near(place).tolist()) for place in range(4)]
    assert near == [{0}, {1}, {2, 3}, {2, 3}]


def test_a_place_is_known_by_its_exact_coordinates() -> None:
    """Anything else is no place."""
    assert LINE.place_at(3.0, 0.0) == 2
    assert LINE.place_at(3.0, 1e-12) is None
    assert LINE.place_at(float("nan"), 0.0) is None
