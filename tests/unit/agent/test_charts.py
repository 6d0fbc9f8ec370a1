"""The maps that an agent knows."""

import numpy as np

from tlcomm_core.agent.charts import Charts
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.grid import Grid

GRID = Grid((2.0, 1.0), 0.5)
OPEN = GRID.free
SHUT = np.where(np.arange(8).reshape(2, 4) % 4 == 2, False, OPEN)


def test_the_scenarios_map_holds_from_the_start() -> None:
    """Until a later one comes; one that isn't later changes nothing."""
    atlas = Atlas(GRID)
    charts = Charts(atlas)
    assert (charts.latest_ns, charts.latest, charts.atlas(5)) == (0, atlas, None)
    assert not charts.take(0, SHUT)
    assert charts.take(5, SHUT)
    assert not charts.take(4, OPEN)
    assert (charts.latest_ns, charts.atlas(0)) == (5, atlas)
    assert len(charts.latest.grid) == 6


def test_equal_maps_share_their_travel_times() -> None:
    """A door that opens again finds the searches of before; other agents find them too."""
    atlas = Atlas(GRID)
    one, two = Charts(atlas), Charts(atlas)
    for charts in (one, two):
        charts.take(5, SHUT)
        charts.take(9, OPEN)
    assert one.atlas(5) is two.atlas(5)
    assert one.atlas(9) is atlas


def test_only_what_an_offer_may_be_made_with_is_kept() -> None:
    """At a departure all but the latest eight are forgotten."""
    charts = Charts(Atlas(GRID))
    times_ns = range(5, 14)
    for map_ns in times_ns:
        charts.take(map_ns, SHUT)
    assert None not in [charts.atlas(map_ns) for map_ns in (0, *times_ns)]
    charts.forget()
    forgotten = [map_ns for map_ns in (0, *times_ns) if charts.atlas(map_ns) is None]
    assert forgotten == [0, 5]
