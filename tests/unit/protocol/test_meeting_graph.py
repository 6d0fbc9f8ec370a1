"""Which links a team relies on at a meeting."""

import numpy as np
import pytest

from support.meetings import make_offers, make_team
from tlcomm_core.protocol.meeting_graph import meeting_graph


@pytest.mark.parametrize(
    ("at_m", "expected"),
    [
        ([(0.0, 0.0)], ((), 1)),
        ([(0.0, 0.0), (0.5, 0.0)], (((0, 1),), 1)),
        # Exactly the planned range apart, one pair more by rounding.
        (
            [(0.0, 0.0), (0.96, 0.0), (0.96, 0.96), (0.0, 0.1 + 0.2 + 0.66)],
            (((0, 1), (0, 3), (1, 2), (2, 3)), 2),
        ),
        # A third pair within R but beyond what is planned with isn't relied on.
        ([(0.0, 0.0), (0.5, 0.0), (0.98, 0.0)], (((0, 1), (1, 2)), 2)),
        # The team isn't connected by sure links: one more is relied on, the longest isn't.
        ([(0.0, 0.0), (0.97, 0.0), (1.2, 0.96)], (((0, 1), (1, 2)), 2)),
        # Not even within R, by poses that are off: the least length that connects all.
        ([(0.0, 0.0), (1.01, 0.0), (2.03, 0.0)], (((0, 1), (1, 2)), 2)),
    ],
)
def test_the_meeting_graph_relies_on_as_little_as_connects(
    at_m: list[tuple[float, float]], expected: tuple[tuple[tuple[int, int], ...], int]
) -> None:
    """Links that hold for sure, or else the shortest that connect the team, and its diameter."""
    offers = make_offers(at_m, [0.0] * len(at_m))
    assert meeting_graph(offers, make_team(len(at_m))) == expected


def test_the_meeting_graph_relies_on_the_surest_sightings_that_connect() -> None:
    """Links that are seen for sure, else those that are seen at all, else those in range."""
    offers = make_offers([(0.0, 0.0), (0.5, 0.0), (0.9, 0.0)], [0.0] * 3)
    team = make_team(3)
    triangle = np.ones((3, 3), dtype=np.bool_)
    chain, pair = triangle.copy(), triangle.copy()
    chain[0, 2] = chain[2, 0] = False
    pair[2, :2] = pair[:2, 2] = False
    assert meeting_graph(offers, team, [triangle]) == (((0, 1), (0, 2), (1, 2)), 1)
    assert meeting_graph(offers, team, [chain, triangle]) == (((0, 1), (1, 2)), 2)
    assert meeting_graph(offers, team, [pair, chain]) == (((0, 1), (1, 2)), 2)
    assert meeting_graph(offers, team, [pair, pair]) == (((0, 1), (0, 2), (1, 2)), 1)
