"""Who hears whom on a map, if obstacles may be in the way."""

from dataclasses import replace

import numpy as np
import pytest

from support.meetings import make_offers
from tlcomm_core.agent.sightings import links_on, sightings
from tlcomm_core.protocol.team import Team
from tlcomm_core.workspace.grid import Grid

# A wall between x = 1 and 1.5, up to y = 1.
GRID = Grid((2.5, 2.0), 0.5, [(1.0, 0.0, 1.5, 1.0)])
BLIND = Team(frozenset({"a", "b"}), 1.2, 60.0, 5.0)
SEEING = replace(BLIND, clearance_m=0.02)
WEST, EAST = (0.75, 0.75), (1.75, 0.75)


def place(point_m: tuple[float, float]) -> int:
    """Return the location at a point."""
    location = GRID.location_at(*point_m)
    assert location is not None
    return location


def test_a_wall_matters_to_radios_that_have_to_see() -> None:
    """Places on both sides of it are linked only if they needn't."""
    assert place(EAST) in links_on(GRID, BLIND).near(place(WEST))
    assert place(EAST) not in links_on(GRID, SEEING).near(place(WEST))
    assert place((0.75, 1.25)) in links_on(GRID, SEEING).near(place(WEST))


@pytest.mark.parametrize("clearance_m", [0.0, 0.02, 0.3])
def test_links_are_mutual(clearance_m: float) -> None:
    """Whoever is linked to another is so the other way round, and to itself."""
    links = links_on(GRID, replace(BLIND, clearance_m=clearance_m))
    linked = np.zeros((len(links), len(links)), dtype=bool)
    for here in range(len(links)):
        linked[here, links.near(here)] = True
    assert (linked == linked.T).all()
    assert linked.diagonal().all()


def test_a_line_along_a_wall_is_not_sure() -> None:
    """From just above a wall's edge, seen from exactly there, but not if both are a little off."""
    offers = make_offers([(0.75, 1.01), (1.75, 1.01), (0.75, 0.75), (1.75, 0.75)], [0.0] * 4)
    surely, perhaps = sightings(GRID, SEEING, offers)
    assert not surely[0, 1]
    assert perhaps[0, 1]
    assert not perhaps[2, 3]
    assert surely[0, 2]
    assert (surely == surely.T).all()


def test_radios_that_need_not_see_are_asked_for_nothing() -> None:
    """Then only the range counts."""
    assert sightings(GRID, BLIND, make_offers([WEST, EAST], [0.0, 0.0])) == ()
