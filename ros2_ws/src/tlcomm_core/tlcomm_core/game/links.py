"""Which places are linked, so that agents at them hear each other.

``within_range``   which places lie within range of which
``Links``          the links between all places of a map
``Neighbourhood``  the same as a table, for sweeps over all places
"""

from collections import defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from numpy.typing import NDArray

__all__ = ["LINK_TOLERANCE_M", "Links", "Neighbourhood", "Sight", "within_range"]

LINK_TOLERANCE_M: Final = 1e-9
"""Rounding that a link is forgiven: two places exactly R apart are linked."""

Sight = Callable[[int, NDArray[np.intp]], NDArray[np.bool_]]
"""Tells which of some places are in sight of one; as much there as back."""


def within_range(
    from_m: NDArray[np.float64], to_m: NDArray[np.float64], range_m: float
) -> NDArray[np.bool_]:
    """Tell which places lie within range of which.

    Args:
        from_m: [A, 2] places.
        to_m: [B, 2] places.
        range_m: R.

    Returns:
        [A, B], fresh.
    """
    east_m = from_m[:, None, 0] - to_m[None, :, 0]
    north_m = from_m[:, None, 1] - to_m[None, :, 1]
    # No hypot: products, sums and square roots are the same on every machine, libm isn't.
    distance_m: NDArray[np.float64] = np.sqrt(east_m * east_m + north_m * north_m)
    return distance_m <= range_m + LINK_TOLERANCE_M


@dataclass(frozen=True, slots=True, eq=False)
class Neighbourhood:
    """Which places are neighbours, as a table.

    Attributes:
        places: int[D, Z] a column for each place: its neighbours. Shorter columns are filled up
            with the place itself if each is its own neighbour, otherwise with Z, where nobody can
            be. (Sweeps over all places take long rows.)
        is_reflexive: whether each place is its own neighbour.
    """

    places: NDArray[np.intp]
    is_reflexive: bool = True

    @classmethod
    def of(cls, columns: Sequence[NDArray[np.intp]], *, is_reflexive: bool) -> "Neighbourhood":
        """Return the table of the neighbours of each place."""
        degree = max((len(column) for column in columns), default=1)
        table = np.tile(_filling(len(columns), is_reflexive=is_reflexive), (degree, 1))
        for place, column in enumerate(columns):
            table[: len(column), place] = column
        table.setflags(write=False)
        return cls(table, is_reflexive)

    def __len__(self) -> int:
        """Return the number of places Z."""
        return self.places.shape[1]

    def among(self, kept: NDArray[np.intp]) -> "Neighbourhood":
        """Return the neighbourhood of some of the places, which keep their order."""
        index = np.full(len(self) + 1, -1, dtype=np.intp)
        index[kept] = np.arange(len(kept))
        places = index[self.places[:, kept]]
        filling = _filling(len(kept), is_reflexive=self.is_reflexive)
        return Neighbourhood(np.where(places < 0, filling, places), self.is_reflexive)

    def least(self, cost: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the least of a cost float[..., Z] over the neighbours of each place, likewise."""
        costs = cost if self.is_reflexive else _with_nowhere(cost)
        least: NDArray[np.float64] = costs.take(self.places, axis=-1).min(axis=-2)
        return least

    def near(self, place: int) -> NDArray[np.intp]:
        """Return the neighbours of a place, which itself may be among them more than once."""
        near = self.places[:, place]
        return near if self.is_reflexive else near[near < len(self)]

    def cheapest(self, cost: NDArray[np.float64], place: int) -> int:
        """Return the neighbour of a place where a cost float[Z] is least; it must have one."""
        near = self.near(place)
        return int(near[np.argmin(cost[near])])


def _with_nowhere(cost: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return costs float[..., Z] with one more place, where nobody can be."""
    return np.append(cost, np.full((*cost.shape[:-1], 1), np.inf), axis=-1)


def _filling(count: int, *, is_reflexive: bool) -> NDArray[np.intp]:
    return np.arange(count, dtype=np.intp) if is_reflexive else np.full(count, count, np.intp)


class Links:
    """The links between all places of a map: in range and, where that counts, in sight.

    Immutable; what is asked for is computed once. A place is linked to itself.

    Attributes:
        locations_m: float[Z, 2] every place.
        range_m: R, the range that places are planned with.

    Source: E(Z_c) in Section IV-B1 of the paper.
    """

    def __init__(
        self, locations_m: NDArray[np.float64], range_m: float, sight: Sight | None = None
    ) -> None:
        """Link the places that are at most ``range_m`` apart and, if given, in sight.

        Args:
            locations_m: float[Z, 2] every place.
            range_m: R.
            sight: which places in range of a place are in its sight; ``None`` for all.
        """
        self.locations_m: Final = locations_m
        self.range_m: Final = range_m
        self._sight = sight
        self._near: dict[int, NDArray[np.intp]] = {}
        self._near_sets: dict[int, frozenset[int]] = {}
        self._crowded: dict[tuple[int, float], NDArray[np.bool_]] = {}

    def __len__(self) -> int:
        """Return the number of places Z."""
        return len(self.locations_m)

    def near(self, place: int) -> NDArray[np.intp]:
        """Return the places linked to one, itself among them, ascending; read-only.

        Cost: O(Z) when it is first asked for.
        """
        near = self._near.get(place)
        if near is None:
            here_m = self.locations_m[place : place + 1]
            near = np.flatnonzero(within_range(here_m, self.locations_m, self.range_m)[0])
            if self._sight is not None:
                near = near[self._sight(place, near) | (near == place)]
            near.setflags(write=False)
            self._near[place] = near
        return near

    @property
    def blind_pairs(self) -> tuple[tuple[int, int], ...]:
        """The pairs of places, i < j, in range of each other but not in sight. Cost: O(Z²)."""
        if self._sight is None:
            return ()
        pairs: list[tuple[int, int]] = []
        for place in range(len(self)):
            here_m, beyond_m = self.locations_m[place : place + 1], self.locations_m[place + 1 :]
            in_range = within_range(here_m, beyond_m, self.range_m)[0]
            in_range[self.near(place)[self.near(place) > place] - place - 1] = False
            pairs += [(place, place + 1 + other) for other in np.flatnonzero(in_range).tolist()]
        return tuple(pairs)

    @classmethod
    def without(
        cls,
        locations_m: NDArray[np.float64],
        range_m: float,
        blind_pairs: Iterable[tuple[int, int]],
    ) -> "Links":
        """Return the links between places in range but for some pairs of them."""
        hidden: dict[int, list[int]] = defaultdict(list)
        for one, other in blind_pairs:
            hidden[one].append(other)
            hidden[other].append(one)

        def sees(place: int, others: NDArray[np.intp]) -> NDArray[np.bool_]:
            return ~np.isin(others, hidden.get(place, []))

        return cls(locations_m, range_m, sees if hidden else None)

    def place_at(self, x_m: float, y_m: float) -> int | None:
        """Return the place that lies exactly there, the first of several; None if none does."""
        return self._places.get((x_m, y_m))

    def crowded(self, place: int, separation_m: float) -> NDArray[np.bool_]:
        """Tell which places are closer to one than a separation > 0; it is itself; read-only.

        Returns:
            [Z].

        Cost: O(Z) when it is first asked for.
        """
        crowded = self._crowded.get((place, separation_m))
        if crowded is None:
            here_m = self.locations_m[place : place + 1]
            closer_m = separation_m - 2.0 * LINK_TOLERANCE_M
            crowded = within_range(here_m, self.locations_m, closer_m)[0]
            crowded.setflags(write=False)
            self._crowded[place, separation_m] = crowded
        return crowded

    def graph(self, places: Iterable[int]) -> dict[int, frozenset[int]]:
        """Return for each of some places those of them that it is linked to, itself excluded."""
        nodes = frozenset(places)
        return {place: (self._near_set(place) & nodes) - {place} for place in sorted(nodes)}

    def components(self, places: Iterable[int]) -> tuple[frozenset[int], ...]:
        """Return the connected components of the graph over some places, each as its places."""
        left = set(places)
        parts: list[frozenset[int]] = []
        while left:
            frontier = [left.pop()]
            part = set(frontier)
            while frontier:
                reached = self._near_set(frontier.pop()) & left
                left -= reached
                part |= reached
                frontier += reached
            parts.append(frozenset(part))
        return tuple(parts)

    def is_connected(self, places: Iterable[int]) -> bool:
        """Tell whether some places form one connected graph; none and one do."""
        return len(self.components(places)) <= 1

    def connecting(self, others: Sequence[int]) -> NDArray[np.bool_]:
        """Tell at which places one more agent makes the team connected.

        Args:
            others: the places of all the others, possibly none.

        Returns:
            [Z], fresh: whether the place is linked to every component of the others' graph.

        Source: Υ_i in Section IV-B3 of the paper, without its ball.
        Cost: O(Z) for each component.
        """
        mask = np.ones(len(self), dtype=np.bool_)
        for part in self.components(others):
            touched = np.zeros(len(self), dtype=np.bool_)
            touched[np.concatenate([self.near(place) for place in part])] = True
            mask &= touched
        return mask

    @cached_property
    def neighbourhood(self) -> Neighbourhood:
        """All links as a table. Cost: O(Z²)."""
        return Neighbourhood.of([self.near(place) for place in range(len(self))], is_reflexive=True)

    def neighbourhood_apart(self, separation_m: float) -> Neighbourhood:
        """Return the links between places at least a separation apart. Cost: O(Z²)."""
        if not separation_m:
            return self.neighbourhood
        rows = []
        for place in range(len(self)):
            near = self.near(place)
            rows.append(near[~self.crowded(place, separation_m)[near]])
        return Neighbourhood.of(rows, is_reflexive=False)

    @cached_property
    def _places(self) -> dict[tuple[float, float], int]:
        points = self.locations_m.tolist()
        return {(x, y): place for place, (x, y) in reversed([*enumerate(points)])}

    def _near_set(self, place: int) -> frozenset[int]:
        near = self._near_sets.get(place)
        if near is None:
            near = self._near_sets[place] = frozenset(self.near(place).tolist())
        return near
