"""How old what agents know of each other is, if all that could be told was.

``InformationAge``   mean and largest ages of a run, for each ordered pair
``information_age``  from the links that there were

Data spread over the links that exist, at once through connected components; what an agent has
heard it passes on later. With s_ij(t) the latest time from which data of agent j can have come to
agent i by t, along links in order of time, the age is

    A_ij(t) = t − s_ij(t),

0 while i and j are in one component, and growing by one second a second while they aren't. When
components join, each member has the newest that any of them has. At the start all know of all. The
links alone decide: what a method makes of them in messages doesn't matter.

The age is linear between changes of the components, so mean and maximum are exact.

Source: the age of information of Kaul, Yates and Gruteser, "Real-time status: how often should one
    update?" (INFOCOM 2012), for sources that are always fresh and links without delay.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.units import seconds
from tlcomm_core.world.observation import Connectivity
from tlcomm_core.world.radio import neighbours

__all__ = ["InformationAge", "information_age"]


@dataclass(frozen=True, slots=True)
class InformationAge:
    """Ages of what agent i (row) has of agent j (column); 0 on the diagonal.

    Attributes:
        mean_s: over the whole run, float[N, N].
        most_s: the largest, float[N, N].
    """

    mean_s: NDArray[np.float64]
    most_s: NDArray[np.float64]

    def mean_of_s(self, agent: int) -> float:
        """Return the mean age of what an agent has of the others."""
        return float(self.mean_s[agent].sum()) / (len(self.mean_s) - 1)

    def most_of_s(self, agent: int) -> float:
        """Return the largest age of what an agent has of the others."""
        return float(self.most_s[agent].max())


@dataclass(frozen=True, slots=True)
class _Split:
    """The team's connected components.

    Attributes:
        component: of each agent, int[N], numbered from 0.
        order: the agents by components, int[N].
        begins: where in ``order`` each component begins.
        apart: whether two agents are in different ones, bool[N, N].
    """

    component: NDArray[np.intp]
    order: NDArray[np.intp]
    begins: NDArray[np.intp]
    apart: NDArray[np.bool_]


def information_age(
    connectivity: Sequence[Connectivity], count: int, end_ns: int
) -> InformationAge | None:
    """Return the ages from the first state of the links to the end.

    Args:
        connectivity: each state of the links, in order of time; the last one holds to the end.
        count: N, how many agents there are.
        end_ns: when the run ended.

    Returns:
        ``None`` without a pair of agents or any time.

    Cost: O(N²) for each change of the components.
    """
    if count <= 1 or not connectivity or end_ns <= connectivity[0].stamp_ns:
        return None
    begin_s = seconds(connectivity[0].stamp_ns)
    fresh_s = np.full((count, count), begin_s)
    area = np.zeros((count, count))
    most_s = np.zeros((count, count))
    for from_s, to_s, split in _spells(connectivity, count, end_ns):
        newest_s = np.maximum.reduceat(fresh_s[split.order], split.begins, axis=0)
        fresh_s = newest_s[split.component]
        area += split.apart * ((to_s - from_s) * (0.5 * (from_s + to_s) - fresh_s))
        most_s = np.maximum(most_s, split.apart * (to_s - fresh_s))
        fresh_s = np.where(split.apart, fresh_s, to_s)
    return InformationAge(area / (seconds(end_ns) - begin_s), most_s)


def _spells(
    connectivity: Sequence[Connectivity], count: int, end_ns: int
) -> Iterator[tuple[float, float, _Split]]:
    """Yield the times (s) from and to which the components stay the same, and these."""
    splits: dict[tuple[int, ...], _Split] = {}
    keys: dict[tuple[tuple[int, int], ...], tuple[int, ...]] = {}
    begun_ns = connectivity[0].stamp_ns
    key: tuple[int, ...] | None = None
    for seen in connectivity:
        if seen.edges not in keys:
            keys[seen.edges] = _components(count, seen.edges)
        following = keys[seen.edges]
        if following == key:
            continue
        if key is not None and seen.stamp_ns > begun_ns:
            yield seconds(begun_ns), seconds(seen.stamp_ns), splits[key]
        begun_ns, key = seen.stamp_ns, following
        splits.setdefault(key, _split(key))
    if key is not None and end_ns > begun_ns:
        yield seconds(begun_ns), seconds(end_ns), splits[key]


def _components(count: int, edges: Sequence[tuple[int, int]]) -> tuple[int, ...]:
    """Return the number of each agent's component, in the order of their first agents."""
    adjacent = neighbours(count, edges)
    found = [-1] * count
    number = 0
    for agent in range(count):
        if found[agent] >= 0:
            continue
        reached = [agent]
        while reached:
            member = reached.pop()
            if found[member] < 0:
                found[member] = number
                reached += adjacent[member]
        number += 1
    return tuple(found)


def _split(components: tuple[int, ...]) -> _Split:
    component = np.array(components, dtype=np.intp)
    order = np.argsort(component, kind="stable")
    begins = np.searchsorted(component[order], np.arange(max(components) + 1))
    return _Split(component, order, begins, component[:, None] != component[None, :])
