"""Tests of ``tlcomm_tools.figures.topologies``."""

import numpy as np

from tlcomm_tools.figures.topologies import topologies_figure
from tlcomm_tools.figures.trace import Trace


def test_each_round_that_took_place_has_a_panel(trace: Trace) -> None:
    """Of those asked for; it says the round and the time."""
    panels = topologies_figure(trace, (1, 2, 58)).axes
    assert [axes.get_title() for axes in panels] == [
        f"r = {own.round} at {own.start_s:.0f} s" for own in trace.meetings
    ]
    assert [axes.get_xlabel() for axes in panels] == ["x (m)", "x (m)"]
    assert [axes.get_ylabel() for axes in panels] == ["y (m)", ""]


def test_links_and_places_are_those_of_the_meeting(trace: Trace) -> None:
    """A line for each link, and a dot for each agent."""
    first = trace.meetings[0]
    (axes,) = topologies_figure(trace, (1,)).axes
    *links, places = axes.lines
    assert len(links) == len(first.links)
    ends = {tuple(map(tuple, line.get_xydata())) for line in links}
    assert ends == {(first.places_m[one], first.places_m[other]) for one, other in first.links}
    np.testing.assert_array_equal(places.get_xydata(), list(first.places_m.values()))


def test_meetings_of_parts_are_drawn_together(trace: Trace) -> None:
    """All of a round that share nobody: of those who met again, the first."""
    whole = trace.meetings[0]
    pair = dict(list(whole.places_m.items())[:2])
    rest = dict(list(whole.places_m.items())[2:])
    parts = tuple(
        whole.model_copy(update={"places_m": places_m, "links": ()})
        for places_m in (pair, rest, pair)
    )
    (axes,) = topologies_figure(trace.model_copy(update={"meetings": parts}), (1,)).axes
    assert [len(line.get_xydata()) for line in axes.lines] == [2, 6]


def test_a_place_of_several_agents_says_of_how_many(trace: Trace) -> None:
    """One dot, and the number beside it."""
    first = trace.meetings[0]
    here = dict.fromkeys(first.places_m, (1.25, 1.25)) | {"agent_8": (1.75, 1.25)}
    meeting = first.model_copy(update={"places_m": here, "links": ()})
    (axes,) = topologies_figure(trace.model_copy(update={"meetings": (meeting,)}), (1,)).axes
    assert [own.get_text() for own in axes.texts] == ["×7"]
    assert len(axes.lines[0].get_xydata()) == 2
