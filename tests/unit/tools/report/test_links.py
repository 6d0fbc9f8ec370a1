"""Who heard whom, from when to when."""

from tlcomm_core.units import nanoseconds
from tlcomm_core.world.observation import Connectivity
from tlcomm_tools.report.links import link_spans


def seen(time_s: float, *edges: tuple[int, int]) -> Connectivity:
    """Return a radio graph."""
    return Connectivity(nanoseconds(time_s), edges, connected=False)


def test_links_begin_and_end() -> None:
    """A link lasts over all graphs that have it, and to the end if the last one does."""
    graphs = [seen(0.0, (0, 1)), seen(1.0, (0, 1), (1, 2)), seen(3.0, (1, 2)), seen(4.0, (1, 2))]
    assert link_spans(graphs, 3, 5.0) == [(0, 1, 0.0, 3.0), (1, 2, 1.0, 5.0)]


def test_links_of_strangers_are_left_out() -> None:
    """A bag may name an agent that the team doesn't have."""
    assert link_spans([seen(0.0, (0, 1), (0, 9))], 2, 1.0) == [(0, 1, 0.0, 1.0)]
