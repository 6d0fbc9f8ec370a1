"""Tests of ``tlcomm_tools.figures.estimates``."""

import numpy as np

from tlcomm_tools.figures.elements import Series
from tlcomm_tools.figures.estimates import estimates_figure
from tlcomm_tools.figures.trace import Trace


def test_estimates_are_compared_with_the_field(trace: Trace) -> None:
    """The lower panel is the upper one less ν."""
    above, below = estimates_figure([trace]).axes
    mean, truth = above.lines
    off, zero = below.lines
    assert trace.field is not None
    times_s = mean.get_xdata()
    assert times_s[0] >= 20.0
    np.testing.assert_allclose(mean.get_ydata(), 53.0)
    np.testing.assert_allclose(off.get_ydata(), 53.0 - trace.field.at(times_s))
    assert truth.get_ydata()[0] == 52.0
    assert tuple(zero.get_ydata()) == (0.0, 0.0)
    assert above.get_ylabel() == "estimate of ν (–)"
    assert (below.get_xlabel(), below.get_ylabel()) == ("time (s)", "deviation from ν (–)")


def test_the_band_reaches_from_the_lowest_to_the_highest_agent(trace: Trace) -> None:
    """The line is their mean; who has no estimate doesn't count."""
    estimates = {
        "agent_1": Series(times_s=(0.0,), values=(50.0,)),
        "agent_2": Series(times_s=(0.0,), values=(56.0,)),
        "agent_3": Series(times_s=(1e9,), values=(99.0,)),
    }
    above, _ = estimates_figure([trace.model_copy(update={"estimates": estimates})]).axes
    np.testing.assert_allclose(above.lines[0].get_ydata(), 53.0)
    (band,) = above.collections
    heights = band.get_paths()[0].vertices[:, 1]
    assert (heights.min(), heights.max()) == (50.0, 56.0)


def test_each_method_with_estimates_has_a_line(trace: Trace) -> None:
    """And the truth one."""
    others = [
        trace.model_copy(update={"method": "static"}),
        trace.model_copy(update={"method": "none", "estimates": {}}),
    ]
    (legend,) = estimates_figure([trace, *others]).legends
    assert [own.get_text() for own in legend.get_texts()] == ["team", "static", "true ν(t)"]
