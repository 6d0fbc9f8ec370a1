"""Ages of information against a search back in time from each of many instants."""

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st

from tlcomm_core.metrics.information_age import information_age
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.observation import Connectivity
from tlcomm_core.world.radio import pair_indices

COUNT = 4
FINE_S = 0.5
Edges = tuple[tuple[int, int], ...]


@st.composite
def histories(draw: st.DrawFn) -> list[tuple[float, float, Edges]]:
    """Return spells (from, to, links) of whole seconds."""
    pairs = list(zip(*(ends.tolist() for ends in pair_indices(COUNT)), strict=True))
    links = st.lists(st.sampled_from(pairs), max_size=3, unique=True).map(sorted).map(tuple)
    lengths = draw(st.lists(st.integers(1, 4), min_size=1, max_size=8))
    ends = np.cumsum(lengths).tolist()
    return [
        (float(end - length), float(end), draw(links))
        for end, length in zip(ends, lengths, strict=True)
    ]


def ages_at(time_s: float, own: int, history: list[tuple[float, float, Edges]]) -> list[float]:
    """Return the age of what an agent has of each at an instant: who can have told it, and when."""
    heard = {own}
    fresh_s = dict.fromkeys(range(COUNT), 0.0)
    fresh_s[own] = time_s
    for from_s, to_s, edges in reversed(history):
        if from_s > time_s:
            continue
        while more := {b for pair in edges for a, b in (pair, pair[::-1]) if a in heard} - heard:
            heard |= more
            for agent in more:
                fresh_s[agent] = min(to_s, time_s)
    return [time_s - fresh_s[agent] for agent in range(COUNT)]


@given(history=histories())
@settings(max_examples=150, deadline=None)
def test_ages_are_those_of_a_search(history: list[tuple[float, float, Edges]]) -> None:
    """Ages are linear within each step, so that the middles of the steps give the exact mean."""
    end_s = history[-1][1]
    middles_s = np.arange(0.5 * FINE_S, end_s, FINE_S).tolist()
    just_before_s = [to_s - 1e-6 for _, to_s, _ in history]
    seen = [
        Connectivity(nanoseconds(from_s), edges, connected=False) for from_s, _, edges in history
    ]
    found = information_age(seen, COUNT, nanoseconds(end_s))
    assert found is not None
    for own in range(COUNT):
        mean_s = np.mean([ages_at(time_s, own, history) for time_s in middles_s], axis=0)
        most_s = np.max([ages_at(time_s, own, history) for time_s in just_before_s], axis=0)
        np.testing.assert_allclose(found.mean_s[own], mean_s, atol=1e-9)
        np.testing.assert_allclose(found.most_s[own], most_s, atol=1e-5)
