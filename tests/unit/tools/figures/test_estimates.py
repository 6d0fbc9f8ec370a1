"""Tests of ``tlcomm_tools.figures.estimates``."""

import numpy as np
import pytest

from tlcomm_tools.figures.elements import Series
from tlcomm_tools.figures.estimates import estimates_figure
from tlcomm_tools.figures.trace import Trace


@pytest.fixture
def certain(trace: Trace) -> Trace:
    """Return a run in which one agent says 50 and one 56, from the second window on."""
    late_s = (trace.period_s,)
    estimates = {
        "agent_1": Series(times_s=late_s, values=(50.0,)),
        "agent_2": Series(times_s=late_s, values=(56.0,)),
        "agent_3": Series(times_s=(1e9,), values=(99.0,)),
    }
    return trace.model_copy(update={"estimates": estimates})


def test_bands_are_of_the_agents_that_have_an_estimate(certain: Trace) -> None:
    """From the lowest to the highest, with the mean between; nothing before the first."""
    above, _ = estimates_figure([certain]).axes
    band, half, mean = (own.get_data() for own in above.patches)
    np.testing.assert_array_equal(band.edges, [0.0, 60.0, 120.0, certain.end_s])
    np.testing.assert_array_equal(band.values, [np.nan, 56.0, 56.0])
    np.testing.assert_array_equal(band.baseline, [np.nan, 50.0, 50.0])
    np.testing.assert_array_equal(half.values, [np.nan, 56.0, 56.0])
    np.testing.assert_array_equal(mean.values, [np.nan, 53.0, 53.0])


def test_the_middle_half_leaves_out_who_is_far_off(certain: Trace) -> None:
    """Four agents agree, one doesn't."""
    agreeing = {f"agent_{n}": Series(times_s=(0.0,), values=(50.0,)) for n in range(4, 8)}
    both = certain.model_copy(update={"estimates": certain.estimates | agreeing})
    above, _ = estimates_figure([both]).axes
    band, half, _ = (own.get_data() for own in above.patches)
    assert (band.values[1], band.baseline[1]) == (56.0, 50.0)
    assert (half.values[1], half.baseline[1]) == (50.0, 50.0)


def test_the_deviation_is_from_the_field_at_the_same_time(certain: Trace) -> None:
    """ν rises by a thirtieth in ten seconds."""
    _, below = estimates_figure([certain]).axes
    band, _, mean = (own.get_data() for own in below.patches)
    assert band.values[1] == pytest.approx(56.0 - 52.2, abs=0.005)
    assert band.baseline[1] == pytest.approx(50.0 - 52.4, abs=0.005)
    assert mean.values[1] == pytest.approx(53.0 - 52.3, abs=0.005)


def test_each_method_with_estimates_has_a_column(trace: Trace) -> None:
    """Named above; axes have names and units."""
    others = [
        trace.model_copy(update={"method": "none", "estimates": {}}),
        trace.model_copy(update={"method": "static"}),
    ]
    figure = estimates_figure([trace, *others])
    assert [axes.get_title() for axes in figure.axes] == ["team", "static", "", ""]
    assert figure.axes[0].get_ylabel() == "estimate of ν (–)"
    assert figure.axes[2].get_ylabel() == "deviation from ν (–)"
    assert [axes.get_xlabel() for axes in figure.axes[2:]] == ["time (s)", "time (s)"]
    (legend,) = figure.legends
    labels = [own.get_text() for own in legend.get_texts()]
    assert labels == ["true ν(t)", "mean", "middle half", "lowest to highest"]
