"""Tests of ``tlcomm_tools.figures.heat_map``."""

from collections import Counter

from tlcomm_tools.figures.heat_map import heat_map_figure
from tlcomm_tools.figures.trace import Trace


def test_each_cell_has_its_count(trace: Trace) -> None:
    """Cells where nobody met stay empty."""
    axes, bar = heat_map_figure(trace).axes
    (heat,) = axes.collections
    counts = {
        tuple(path.vertices.min(axis=0).tolist()): count
        for path, count in zip(heat.get_paths(), heat.get_array(), strict=True)
    }
    expected = Counter(
        (x_m // 0.5 * 0.5, y_m // 0.5 * 0.5)
        for own in trace.meetings
        for x_m, y_m in own.places_m.values()
    )
    assert counts == expected
    assert heat.get_clim() == (0.0, max(expected.values()))
    assert bar.get_ylabel() == "times an agent met there"
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("x (m)", "y (m)")
