"""Tests of ``tlcomm_tools.figures.workspace`` and ``plan_view``."""

from matplotlib.patches import Circle, Rectangle

from tlcomm_tools.figures.trace import Trace
from tlcomm_tools.figures.workspace import workspace_figure


def test_the_workspace_is_drawn_to_scale(trace: Trace) -> None:
    """In metres, with every obstacle and region, and every region's name inside the frame."""
    (axes,) = workspace_figure(trace).axes
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x (m)", "y (m)")
    assert (axes.get_xlim(), axes.get_ylim()) == ((0.0, 10.0), (0.0, 10.0))
    assert axes.get_aspect() == 1.0
    assert sum(isinstance(own, Rectangle) for own in axes.patches) == 6
    assert sum(isinstance(own, Circle) for own in axes.patches) == 10
    names = {own.get_text(): own for own in axes.texts}
    assert trace.ground.regions_m.keys() < names.keys()
    assert (names["m1"].get_va(), names["m2"].get_va()) == ("top", "bottom")


def test_ways_begin_at_the_start_and_end_with_the_task(trace: Trace) -> None:
    """Those of every second agent, shifted by less than a cell."""
    figure = workspace_figure(trace)
    (axes,) = figure.axes
    (legend,) = figure.legends
    labels = [text.get_text() for text in legend.get_texts()]
    assert labels == ["agent 1", "agent 3", "agent 5", "agent 7"]
    ways = {line.get_label(): line.get_xydata() for line in axes.lines}
    first = trace.paths["agent_3"]
    assert abs(ways["agent 3"][0][0] - first.x_m[0]) < 0.25
    m4_x_m, m4_y_m, radius_m = trace.ground.regions_m["m4"]
    assert abs(ways["agent 7"][-1][0] - m4_x_m) < radius_m + 0.25
    assert abs(ways["agent 7"][-1][1] - m4_y_m) < radius_m + 0.25


def test_every_agents_start_bears_its_number(trace: Trace) -> None:
    """At the place itself."""
    (axes,) = workspace_figure(trace).axes
    starts = {own.get_text(): own.get_position() for own in axes.texts if own.get_text().isdigit()}
    assert sorted(starts) == ["1", "2", "3", "4", "5", "6", "7", "8"]
    assert starts["1"] == (4.25, 4.75)
