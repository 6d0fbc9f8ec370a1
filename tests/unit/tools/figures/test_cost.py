"""Tests of ``tlcomm_tools.figures.cost``."""

from tlcomm_tools.figures.cost import cost_figure
from tlcomm_tools.figures.trace import Trace


def test_each_course_is_a_line_and_what_was_agreed_a_mark(trace: Trace) -> None:
    """The marks are beyond the last iteration, under a name of their own."""
    figure = cost_figure(trace)
    (axes,) = figure.axes
    courses = [line for line in axes.lines if str(line.get_label()).startswith("r = ")]
    assert [line.get_label() for line in courses] == ["r = 1", "r = 2"]
    for line, course in zip(courses, trace.courses, strict=True):
        assert tuple(line.get_ydata()) == course.potentials_s
    beyond = max(len(own.potentials_s) for own in trace.courses) + 1.0
    marks = {
        tuple(point) for line in axes.lines for point in line.get_xydata() if point[0] == beyond
    }
    assert marks == {(beyond, own.agreed_s) for own in trace.agreements[:2]}
    assert axes.get_xticklabels()[-1].get_text() == "agreed"
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("iteration k", "potential Φ (s)")
