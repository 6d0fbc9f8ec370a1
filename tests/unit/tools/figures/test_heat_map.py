"""Tests of ``tlcomm_tools.figures.heat_map``."""

import numpy as np

from tlcomm_tools.figures.heat_map import heat_map_figure
from tlcomm_tools.figures.trace import Trace


def test_each_cell_has_its_count(trace: Trace) -> None:
    """Cells where nobody met stay empty."""
    axes, bar = heat_map_figure(trace).axes
    (mesh,) = axes.collections
    counts = np.ma.filled(mesh.get_array(), np.nan)
    assert counts.shape == (20, 20)
    assert np.nansum(counts) == 2 * len(trace.paths)
    assert np.nanmin(counts) == 1.0
    x_m, y_m = trace.meetings[0].places_m["agent_1"]
    assert counts[int(y_m / 0.5), int(x_m / 0.5)] >= 1.0
    assert bar.get_ylabel() == "times an agent met there"
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x (m)", "y (m)")
