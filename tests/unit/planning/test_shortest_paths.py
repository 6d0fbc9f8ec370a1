"""Shortest paths with the fewest edges."""

import numpy as np

from tlcomm_core.planning.shortest_paths import Arcs, Graph, ShortestPaths


def arcs(*rows: tuple[int, int, int]) -> Arcs:
    """Return edges (source, target, time), named by their order."""
    columns = np.array(rows, dtype=np.int64).reshape(-1, 3).T
    return Arcs(columns[0], columns[1], columns[2], np.arange(len(rows)))


def test_of_equally_fast_paths_the_one_with_fewer_edges_is_taken() -> None:
    """One edge of 2 ns beats two of 1 ns."""
    graph = Graph(3, arcs((0, 1, 1), (1, 2, 1), (0, 2, 2)))
    assert ShortestPaths(graph, 0).path_to(2) == (2,)


def test_a_faster_path_beats_one_with_fewer_edges() -> None:
    """Two edges of 1 ns beat one of 3 ns."""
    graph = Graph(3, arcs((0, 1, 1), (1, 2, 1), (0, 2, 3)))
    assert ShortestPaths(graph, 0).path_to(2) == (0, 1)


def test_edges_of_no_time_are_edges() -> None:
    """A path may take no time at all."""
    paths = ShortestPaths(Graph(4, arcs((0, 1, 0), (1, 2, 0))), 0)
    assert paths.times_ns.tolist() == [0.0, 0.0, 0.0, np.inf]
    assert paths.path_to(2) == (0, 1)


def test_of_parallel_edges_the_fastest_is_kept_and_the_first_of_equals() -> None:
    """Duplicates never add up."""
    graph = Graph(2, arcs((0, 1, 5), (0, 1, 3), (0, 1, 3)))
    assert graph.arcs.name.tolist() == [1]
    assert ShortestPaths(graph, 0).times_ns[1] == 3.0


def test_a_limit_keeps_what_lies_on_it() -> None:
    """Times equal to the limit are found, larger ones aren't."""
    graph = Graph(3, arcs((0, 1, 2), (1, 2, 1)))
    assert graph.times_from(0, 2.0).tolist() == [0.0, 2.0, np.inf]


def test_the_root_is_reached_by_no_edge() -> None:
    """The path from a state to itself is empty, even with a loop of no time there."""
    assert ShortestPaths(Graph(1, arcs((0, 0, 0))), 0).path_to(0) == ()
