"""Range, links and hops."""

import numpy as np
import pytest

from tlcomm_core.world.radio import diameter, is_connected, links, neighbours

LINE = ((0, 1), (1, 2), (2, 3))


def test_the_range_itself_is_within_range() -> None:
    """A distance of R is linked, the next larger distance isn't."""
    beyond = np.nextafter(2.0, 3.0)
    assert links(np.array([[1.0, 0.0], [2.0, 0.0]]), 1.0) == ((0, 1),)
    assert links(np.array([[0.0, 0.0], [2.0, 0.0]]), 2.0) == ((0, 1),)
    assert links(np.array([[0.0, 0.0], [beyond, 0.0]]), 2.0) == ()


def test_links_are_ascending_pairs() -> None:
    """Pairs come by the first index, then the second."""
    corners = np.array([[0.0, 0.0], [3.0, 0.0], [0.6, 0.0], [3.0, 0.6], [0.0, 0.6]])
    assert links(corners, 1.0) == ((0, 2), (0, 4), (1, 3), (2, 4))


def test_one_node_or_none_has_no_links() -> None:
    """Nothing to pair."""
    assert links(np.zeros((1, 2)), 1.0) == ()
    assert links(np.zeros((0, 2)), 1.0) == ()


def test_neighbours_are_mutual() -> None:
    """Each edge makes two neighbours."""
    assert neighbours(4, LINE) == (
        frozenset({1}), frozenset({0, 2}), frozenset({1, 3}), frozenset({2}),
    )  # fmt: skip


@pytest.mark.parametrize(
    ("count", "edges", "hops"),
    [
        (0, (), 0),
        (1, (), 0),
        (2, (), None),
        (2, ((0, 1),), 1),
        (4, LINE, 3),
        (4, (*LINE, (0, 3)), 2),
        (4, ((0, 1), (2, 3)), None),
        (5, ((0, 4), (1, 4), (2, 4), (3, 4)), 2),
    ],
)
def test_diameter_and_connection(
    count: int, edges: tuple[tuple[int, int], ...], hops: int | None
) -> None:
    """A connected graph has its known diameter, others have none."""
    assert diameter(count, edges) == hops
    assert is_connected(count, edges) is (hops is not None)
