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
    assert names["m1"].get_position()[1] < 9.25 - 0.5
    assert names["m2"].get_position()[1] > 7.75 + 0.5


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


def test_names_cover_no_others(trace: Trace) -> None:
    """Two regions at one place have their names above and below it."""
    regions_m = {"north": (5.0, 5.0, 0.5), "south": (5.0, 5.0, 0.5)}
    crowded = trace.model_copy(
        update={"ground": trace.ground.model_copy(update={"regions_m": regions_m})}
    )
    (axes,) = workspace_figure(crowded).axes
    heights_m = {own.get_text(): own.get_position()[1] for own in axes.texts}
    assert heights_m["north"] > 5.5
    assert heights_m["south"] < 4.5


def test_a_figure_is_as_high_as_the_workspace_needs(trace: Trace) -> None:
    """And as wide as many regions need."""
    flat = trace.ground.model_copy(update={"size_m": (10.0, 2.0)})
    full = trace.ground.model_copy(
        update={"regions_m": {f"r{n}": (n / 3.0, 1.0, 0.1) for n in range(13)}}
    )
    plain, low, wide = (
        workspace_figure(trace.model_copy(update={"ground": ground})).get_size_inches()
        for ground in (trace.ground, flat, full)
    )
    assert plain[0] == low[0] == 3.5
    assert low[1] < plain[1] - 2.0
    assert wide[0] == 7.16


def test_starts_too_close_for_numbers_are_dots(trace: Trace) -> None:
    """Numbers upon each other say nothing."""
    vast = trace.ground.model_copy(update={"size_m": (100.0, 100.0)})
    (axes,) = workspace_figure(trace.model_copy(update={"ground": vast})).axes
    assert not [own for own in axes.texts if own.get_text().isdigit()]


def test_every_agents_start_bears_its_number(trace: Trace) -> None:
    """At the place itself."""
    (axes,) = workspace_figure(trace).axes
    starts = {own.get_text(): own.get_position() for own in axes.texts if own.get_text().isdigit()}
    assert sorted(starts) == ["1", "2", "3", "4", "5", "6", "7", "8"]
    assert starts["1"] == (4.25, 4.75)
