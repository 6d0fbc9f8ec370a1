"""What follows from a scenario and is shared by all that use it.

``Site``             the grid, where the regions are, and each agent's abilities
``grid_of``          the grid of a workspace
``later_grids``      those that its changes make
``region_location``  the location at which a region is visited
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Self

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.geometry import Pose
from tlcomm_core.scenario.model import Region, Scenario, Workspace
from tlcomm_core.workspace.grid import Box, Disc, Grid
from tlcomm_core.workspace.travel import Motion

__all__ = ["Site", "grid_of", "later_grids", "region_location"]


@dataclass(frozen=True, slots=True)
class Site:
    """A checked scenario with its derived objects.

    Attributes:
        scenario: as loaded.
        grid: cells and locations.
        region_location: the location at which each region is visited, of those that have one.
        region_discs: each region's middle and radius (x, y, r) in metres.
        regions_beside: for each region the others whose discs overlap with its own.
    """

    scenario: Scenario
    grid: Grid
    region_location: MappingProxyType[str, int]
    region_discs: MappingProxyType[str, Disc]
    regions_beside: MappingProxyType[str, frozenset[str]]
    _members: tuple[tuple[str, NDArray[np.intp]], ...]

    @classmethod
    def from_scenario(cls, scenario: Scenario) -> Self:
        """Derive everything from a scenario that passed its checks. Cost: O(regions · Z)."""
        return cls._on(grid_of(scenario.workspace), scenario)

    def on(self, grid: Grid) -> Self:
        """Return what follows if the map is another: regions that it closes have no location."""
        return self._on(grid, self.scenario)

    @classmethod
    def _on(cls, grid: Grid, scenario: Scenario) -> Self:
        locations: dict[str, int] = {}
        members: list[tuple[str, NDArray[np.intp]]] = []
        regions = scenario.workspace.regions
        for name, region in regions.items():
            location = region_location(grid, region)
            if location is not None:
                locations[name] = location
            members.append((name, grid.locations_within(*region.at_m, region.radius_m)))
        discs = {name: (*region.at_m, region.radius_m) for name, region in regions.items()}
        return cls(
            scenario=scenario,
            grid=grid,
            region_location=MappingProxyType(locations),
            region_discs=MappingProxyType(discs),
            regions_beside=MappingProxyType(_overlaps(discs)),
            _members=tuple(members),
        )

    @property
    def planned_range_m(self) -> float:
        """Range that meetings are planned with: R less what two controllers may be off."""
        return self.scenario.communication.range_m - 2.0 * self.scenario.position_tolerance_m

    @property
    def planned_clearance_m(self) -> float | None:
        """Clearance that sight lines are planned with: what each of two controllers may be off.

        ``None`` if radios reach past obstacles.
        """
        sees = self.scenario.radio.line_of_sight
        return self.scenario.position_tolerance_m if sees else None

    def regions_at(self, location: int) -> frozenset[str]:
        """Return the regions whose disc contains a location."""
        return frozenset(name for name, members in self._members if location in members)

    def motion_of(self, agent: str, segment_allowance_s: float = 0.0) -> Motion:
        """Return an agent's motion with an allowance per segment."""
        drive = self.scenario.drive_of(agent)
        return Motion(drive.linear_mps, drive.angular_radps, segment_allowance_s)

    def action_durations(self, agent: str) -> dict[str, float]:
        """Return the durations (s) of an agent's actions; fresh."""
        return self.scenario.actions_of(agent)

    def start_of(self, agent: str) -> Pose:
        """Return the pose in which an agent starts."""
        return Pose(*self.scenario.agents[agent].start)


def grid_of(workspace: Workspace) -> Grid:
    """Return the grid of a workspace."""
    return _grid(workspace, workspace.obstacles_m)


def later_grids(workspace: Workspace) -> tuple[Grid, ...]:
    """Return the grid that each change of a workspace makes. Cost: O(changes · Z)."""
    return tuple(_grid(workspace, change.obstacles_m) for change in workspace.changes)


def _grid(workspace: Workspace, boxes: Sequence[Box]) -> Grid:
    return Grid(workspace.size_m, workspace.cell_m, boxes, workspace.origin_m)


def region_location(grid: Grid, region: Region) -> int | None:
    """Return the free centre nearest to a region's middle; None if none lies in its disc.

    Ties go to the lowest index.
    """
    inside = grid.locations_within(*region.at_m, region.radius_m)
    if not len(inside):
        return None
    offsets = grid.locations_m[inside] - np.array(region.at_m)
    return int(inside[np.argmin(np.hypot(offsets[:, 0], offsets[:, 1]))])


def _overlaps(discs: Mapping[str, Disc]) -> dict[str, frozenset[str]]:
    """Return for each disc the names of the others that it shares a point with."""
    x_m, y_m, radius_m = np.array(list(discs.values())).T
    overlaps: dict[str, frozenset[str]] = {}
    for name, (own_x_m, own_y_m, own_radius_m) in discs.items():
        near = np.hypot(x_m - own_x_m, y_m - own_y_m) <= radius_m + own_radius_m
        names = {other for other, is_near in zip(discs, near.tolist(), strict=True) if is_near}
        overlaps[name] = frozenset(names - {name})
    return overlaps
