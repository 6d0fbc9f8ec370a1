"""A small plant for planning tests: five regions around a wall, one of them shut in."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from tlcomm_core.geometry import Pose
from tlcomm_core.planning.plan import LocalPlan, PlanStep
from tlcomm_core.planning.repertoire import Condition
from tlcomm_core.planning.transition_system import TransitionSystem, build
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.travel import Motion, TravelTimes

__all__ = ["ACTIONS", "START", "SmallPlant"]

Word = list[frozenset[str]]

START = Pose(1.75, 0.25, 0.0)
ACTIONS = {"collect": 4.0, "unload": 2.5}
# "hall" overlaps "p"; "vault" is walled in.
_REGIONS = {
    "p": (0.25, 0.25, 0.3),
    "hall": (0.75, 0.25, 0.6),
    "r": (3.25, 0.75, 0.3),
    "m": (1.75, 3.25, 0.3),
    "vault": (3.75, 3.75, 0.2),
}
_WALLS = [(1.5, 1.0, 2.5, 2.5), (3.0, 3.0, 3.5, 4.0), (3.5, 3.0, 4.0, 3.5)]


@dataclass(frozen=True)
class SmallPlant:
    """The plant with some of its regions."""

    regions: tuple[str, ...] = tuple(_REGIONS)
    times: TravelTimes = field(
        default_factory=lambda: TravelTimes(Grid((4.0, 4.0), 0.5, _WALLS), Motion(1.0, 1.5))
    )

    def location(self, region: str) -> int:
        """Return where a region is."""
        x_m, y_m, _ = _REGIONS[region]
        location = self.times.grid.location_at(x_m, y_m)
        assert location is not None
        return location

    def regions_at(self, location: int) -> frozenset[str]:
        """Return the regions whose discs contain a location."""
        x_m, y_m = self.times.grid.locations_m[location].tolist()
        return frozenset(
            name
            for name in self.regions
            if Pose(x_m, y_m, 0.0).distance_m(*_REGIONS[name][:2]) <= _REGIONS[name][2]
        )

    def system(
        self,
        start: Pose = START,
        actions: Mapping[str, float] | None = None,
        conditions: Mapping[str, Condition] | None = None,
    ) -> TransitionSystem:
        """Return the transition system from a start."""
        locations = {name: self.location(name) for name in self.regions}
        durations_s = ACTIONS if actions is None else actions
        given = conditions or {}
        return build(self.times, start, locations, self.regions_at, durations_s, given)

    def word(self, plan: LocalPlan, start: Pose = START) -> tuple[Word, Word]:
        """Return stem and loop of the word that a plan produces, the start's label first."""
        first = self.times.grid.location_at(start.x_m, start.y_m)
        assert first is not None
        stem = [self.regions_at(first), *map(self.label, plan.prefix)]
        return stem, [self.label(step) for step in plan.suffix]

    def label(self, step: PlanStep) -> frozenset[str]:
        """Return what is true during a step."""
        return self.regions_at(step.location) | ({step.action} if step.action else set())

    def execute(self, steps: tuple[PlanStep, ...], pose: Pose) -> tuple[float, Pose]:
        """Return time and final pose of doing some steps leg by leg."""
        total_s = 0.0
        for step in steps:
            leg = self.times.leg_to(pose, step.location)
            total_s += leg.duration_s + step.duration_s
            pose = leg.arrival
        return total_s, pose

    def driven_m(self, steps: tuple[PlanStep, ...], pose: Pose) -> float:
        """Return how far doing some steps leads, leg by leg."""
        total_m = 0.0
        for step in steps:
            leg = self.times.leg_to(pose, step.location)
            total_m += leg.distance_m
            pose = leg.arrival
        return total_m
