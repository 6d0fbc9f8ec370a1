"""The graph of lattice states (z, k): at location z, turned to lattice heading k.

``Lattice``       the graph and its two searches
``PathTree``      what a search returns
``Arrivals``      how the paths into a place end
``HEADINGS``      number of lattice headings
``HEADINGS_RAD``  the lattice headings

State (z, k) is node ``z * HEADINGS + k``. Turns lead between adjacent headings (more add up),
straights to the neighbouring cell along the heading.
"""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csr_array
from scipy.sparse.csgraph import dijkstra

from tlcomm_core.geometry import wrap_angle
from tlcomm_core.workspace.grid import HEADING_STEPS, Grid

__all__ = ["HEADINGS", "HEADINGS_RAD", "Arrivals", "Lattice", "PathTree"]

HEADINGS: Final = 8
HEADINGS_RAD: Final = tuple(wrap_angle(k * math.tau / HEADINGS) for k in range(HEADINGS))


@dataclass(frozen=True, slots=True)
class Arrivals:
    """How legs from every lattice state end at one place.

    Attributes:
        heading: lattice heading on arrival, int[Z, 8], by location and lattice heading; the own
            one where nothing is driven or no path leads there.
        distance_m: length of all straights, float[Z, 8]; 0 where no path leads there.
    """

    heading: NDArray[np.int64]
    distance_m: NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class PathTree:
    """Shortest paths between one place and every state.

    Attributes:
        time_s: length of the path, float[Z * HEADINGS]; inf where there is none; read-only.
        next_node: the next state on the path towards the tree's root, int32[Z * HEADINGS];
            not a state (out of bounds) at the root and where there is no path; read-only.
    """

    time_s: NDArray[np.float64]
    next_node: NDArray[np.int32]

    @property
    def nbytes(self) -> int:
        """Size of both arrays."""
        return self.time_s.nbytes + self.next_node.nbytes

    def arrivals(self, target: int, locations_m: NDArray[np.float64]) -> Arrivals:
        """Return how the paths end, in a tree of paths into a place.

        Args:
            target: the place, a location.
            locations_m: where the locations are, float[Z, 2].

        Cost: O(Z log Z): every state looks ever twice as far ahead on its path.
        """
        nodes = np.arange(len(self.time_s))
        is_end = (nodes // HEADINGS == target) | np.isinf(self.time_s)
        ahead = np.where(is_end, nodes, self.next_node)
        offsets_m = locations_m[ahead // HEADINGS] - locations_m[nodes // HEADINGS]
        distance_m = np.hypot(offsets_m[:, 0], offsets_m[:, 1])
        while not np.array_equal(further := ahead[ahead], ahead):
            distance_m += distance_m[ahead]
            ahead = further
        return Arrivals(
            heading=(ahead % HEADINGS).reshape(-1, HEADINGS),
            distance_m=distance_m.reshape(-1, HEADINGS),
        )


class Lattice:
    """States and moves on a grid, with the time that each move takes."""

    def __init__(self, grid: Grid, turn_s: float, linear_mps: float) -> None:
        """Build the graph.

        Args:
            grid: where to move.
            turn_s: time of a turn to an adjacent heading.
            linear_mps: speed on straights.
        """
        self._size: Final = len(grid) * HEADINGS
        self._edges: Final = _edges(grid, turn_s, linear_mps)

    def paths_into(self, location: int) -> PathTree:
        """Return the shortest paths from every state into a location, at any heading there."""
        return self._search(self._backward, location, (0.0,) * HEADINGS)

    def paths_out_of(self, location: int, heading_s: tuple[float, ...]) -> PathTree:
        """Return the shortest paths from a location to every state.

        Args:
            location: where to start.
            heading_s: time spent before the start at each lattice heading; inf to exclude one.
        """
        return self._search(self._forward, location, heading_s)

    @cached_property
    def _forward(self) -> csr_array:
        sources, targets, times_s = self._edges
        return csr_array((times_s, (sources, targets)), shape=(self._size, self._size))

    @cached_property
    def _backward(self) -> csr_array:
        sources, targets, times_s = self._edges
        return csr_array((times_s, (targets, sources)), shape=(self._size, self._size))

    def _search(self, graph: csr_array, location: int, heading_s: tuple[float, ...]) -> PathTree:
        """Search from one more node, the root, that leads to the location's states."""
        headings = np.flatnonzero(np.isfinite(heading_s))
        entries = len(graph.data) + len(headings)
        rooted = csr_array(
            (
                np.append(graph.data, np.array(heading_s)[headings]),
                np.append(graph.indices, (location * HEADINGS + headings).astype(np.int32)),
                np.append(graph.indptr, np.int32(entries)),
            ),
            shape=(self._size + 1, self._size + 1),
        )
        times_s, predecessors = dijkstra(rooted, indices=[self._size], return_predecessors=True)
        tree = PathTree(times_s[0, :-1], predecessors[0, :-1])
        tree.time_s.setflags(write=False)
        tree.next_node.setflags(write=False)
        return tree


def _edges(
    grid: Grid, turn_s: float, linear_mps: float
) -> tuple[NDArray[np.int64], NDArray[np.int64], NDArray[np.float64]]:
    """Return sources, targets and times of all turns and straights."""
    nodes = np.arange(len(grid) * HEADINGS).reshape(-1, HEADINGS)
    locations, headings = np.nonzero(grid.moves >= 0)
    straight_s = np.array([math.hypot(*step) for step in HEADING_STEPS]) * grid.cell_m / linear_mps
    sources = np.concatenate((nodes.ravel(), nodes.ravel(), nodes[locations, headings]))
    targets = np.concatenate(
        (
            np.roll(nodes, -1, axis=1).ravel(),
            np.roll(nodes, 1, axis=1).ravel(),
            nodes[grid.moves[locations, headings], headings],
        )
    )
    times_s = np.concatenate((np.full(2 * nodes.size, turn_s), straight_s[headings]))
    return sources, targets, times_s
