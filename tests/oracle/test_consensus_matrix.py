"""Consensus by messages against the iteration of its matrix.

Source: R. Olfati-Saber, J. A. Fax and R. M. Murray, "Consensus and Cooperation in Networked
    Multi-Agent Systems", Proc. IEEE 95(1), 2007: x(k + 1) = (I − ε L) x(k).
"""

import networkx as nx
import numpy as np
import pytest

from support.estimating_team import EstimatingTeam
from tlcomm_core.agent.averaging import Consensus

NAMES = "abcdefgh"
# Less than any difference that is left after the exchanges compared.
TOLERANCE = 1e-13
EXCHANGES = 12


def metropolis(graph: "nx.Graph[str]") -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """Return I − Σ ε_ij (e_i − e_j)(e_i − e_j)ᵀ with ε_ij = 1 / (1 + max(d_i, d_j))."""
    matrix = np.eye(len(NAMES))
    for i, j in graph.edges:
        direction = np.zeros(len(NAMES))
        direction[NAMES.index(i)], direction[NAMES.index(j)] = 1.0, -1.0
        weight = 1.0 / (1 + max(graph.degree[i], graph.degree[j]))
        matrix -= weight * np.outer(direction, direction)
    return matrix


def laplacian(
    graph: "nx.Graph[str]", step: float
) -> np.ndarray[tuple[int, int], np.dtype[np.float64]]:
    """Return I − ε L."""
    return np.eye(len(NAMES)) - step * nx.laplacian_matrix(graph, list(NAMES)).toarray()


@pytest.mark.parametrize("step", [None, 0.14])
@pytest.mark.parametrize("seed", range(10))
def test_values_are_those_of_the_matrix(step: float | None, seed: int) -> None:
    """After each exchange, on a random graph, with a given step and with one by neighbours."""
    rng = np.random.default_rng(seed)
    graph = nx.relabel_nodes(
        nx.connected_watts_strogatz_graph(8, 4, 0.5, seed=seed), dict(enumerate(NAMES))
    )
    expected = rng.uniform(0.0, 10.0, len(NAMES))
    matrix = metropolis(graph) if step is None else laplacian(graph, step)
    team = EstimatingTeam(NAMES, lambda own: Consensus(own, step, TOLERANCE))
    team.read(dict(zip(NAMES, expected.tolist(), strict=True)))
    team.link(list(graph.edges))
    # At first everybody only says what it has measured.
    team.exchange()
    for _ in range(EXCHANGES):
        team.exchange()
        expected = matrix @ expected
        values = [team.values[name] for name in NAMES]
        np.testing.assert_allclose(values, expected, rtol=0.0, atol=1e-9)
