"""The sim node's parameters, validated.

``SimConfig``  what to run
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Self

from tlcomm_core.errors import InputError
from tlcomm_core.mission import Mission, create_world
from tlcomm_core.pace import Pace, parse_pace
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.lockstep import LockStep
from tlcomm_core.world.world import World
from tlcomm_sim.conductor import RECORDER, Conductor
from tlcomm_sim.freerun import FreeRunConductor
from tlcomm_sim.lockstep import LockStepConductor

__all__ = ["SimConfig"]


@dataclass(frozen=True, slots=True)
class SimConfig:
    """What to run.

    Attributes:
        mission: scenario, seed and end.
        pace: lock step or a factor.
        has_recorder: whether a recorder takes part.
    """

    mission: Mission
    pace: Pace
    has_recorder: bool

    @classmethod
    def from_parameters(cls, get: Callable[[str], object]) -> Self:
        """Read a node's parameters.

        Raises:
            InputError: one of them is missing or malformed.
        """
        site = Site.from_scenario(load_scenario(_text(get("scenario"), "scenario")))
        if RECORDER in site.scenario.agents:
            raise InputError(f"agents: {RECORDER!r} is the recorder's own name")
        rounds, until_s = get("rounds"), get("until_s")
        if rounds is not None and not (isinstance(rounds, int) and rounds >= 0):
            raise InputError(f"rounds: {rounds!r} isn't a number of rounds")
        if until_s is not None and not (isinstance(until_s, int | float) and until_s > 0):
            raise InputError(f"until_s: {until_s!r} isn't a positive time")
        seed = get("seed")
        if not (isinstance(seed, int) and seed >= 0):
            raise InputError(f"seed: {seed!r} isn't an integer ≥ 0")
        mission = Mission(site, seed, rounds, None if until_s is None else float(until_s))
        return cls(mission, parse_pace(str(get("pace"))), bool(get("recorder")))

    @property
    def measures(self) -> bool:
        """Whether agents measure anything."""
        return self.mission.site.scenario.field is not None

    def create_world(self) -> World:
        """Return the mission's world at t = 0."""
        return create_world(self.mission.site, self.mission.seed)

    def create_conductor(self, world: World) -> Conductor:
        """Return a conductor over a world at t = 0."""
        scenario, stop = self.mission.site.scenario, self.mission.stop
        agents = tuple(scenario.agents)
        if self.pace.factor is None:
            latency_ns = nanoseconds(scenario.communication.hop_latency_s)
            lockstep = LockStep(world, agents, latency_ns, stop)
            return LockStepConductor(lockstep, agents, has_recorder=self.has_recorder)
        return FreeRunConductor(
            world, agents, stop, self.pace.factor, has_recorder=self.has_recorder
        )


def _text(value: object, name: str) -> str:
    if not isinstance(value, str) or not value:
        raise InputError(f"{name}: {value!r} isn't a file's name")
    return value
