"""What agents read of the field.

``Sensors``  give a reading to whoever is at a station
"""

from collections.abc import Mapping
from math import hypot
from typing import Final, Self

import numpy as np

from tlcomm_core.field.field import Field
from tlcomm_core.scenario.site import Site
from tlcomm_core.units import seconds
from tlcomm_core.workspace.grid import Disc

__all__ = ["Sensors"]

_ROUNDING_M: Final = 1e-9


class Sensors:
    """The agents' sensors: each reads the station at which its agent truly is."""

    def __init__(
        self, field: Field, discs: Mapping[str, Disc], noise: float = 0.0, seed: int = 0
    ) -> None:
        """Make everybody's sensor.

        Args:
            field: what is measured.
            discs: middle and radius of each region.
            noise: standard deviation of each reading.
            seed: the run's.
        """
        self._field: Final = field
        self._discs: Final = discs
        self._noise: Final = noise
        self._seed: Final = seed
        self._rngs: Final[dict[str, np.random.Generator]] = {}

    @classmethod
    def of(cls, site: Site, seed: int) -> Self | None:
        """Return the sensors of a scenario; ``None`` if there is nothing to measure."""
        field, section = Field.of(site.scenario), site.scenario.field
        if field is None or section is None:
            return None
        return cls(field, site.region_discs, section.noise, seed)

    def read(
        self, agent: str, region: str, at_m: tuple[float, float], time_ns: int
    ) -> float | None:
        """Return what an agent reads; ``None`` if it isn't at that station.

        Args:
            agent: whose sensor.
            region: where it says that it is.
            at_m: where it truly is, x and y.
            time_ns: when.
        """
        if region not in self._field.stations:
            return None
        x_m, y_m, radius_m = self._discs[region]
        if hypot(at_m[0] - x_m, at_m[1] - y_m) > radius_m + _ROUNDING_M:
            return None
        return self._field.reading(region, seconds(time_ns)) + self._error(agent)

    def _error(self, agent: str) -> float:
        """Return an error drawn from the agent's own generator: what others read doesn't matter."""
        if self._noise == 0.0:
            return 0.0
        if agent not in self._rngs:
            origin = f"reading of {agent}".encode()
            self._rngs[agent] = np.random.default_rng([self._seed, *origin])
        return self._noise * float(self._rngs[agent].standard_normal())
