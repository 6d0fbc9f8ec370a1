"""The field over time, and what its stations read.

``Field``  ν(t), and each station's reading
"""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final, Self, overload

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.scenario.measurements import stations_of
from tlcomm_core.scenario.model import Scenario

__all__ = ["Field"]


class Field:
    """A value that is the same everywhere, and what stations read of it: ν and a drift.

    Source: Section V-C: ν(t) is piecewise linear; what is measured at a station has a sinusoid
        added. (That each station has its own phase is ours: the paper doesn't say.)
    """

    def __init__(
        self,
        profile: tuple[tuple[float, float], ...],
        stations: Mapping[str, float],
        amplitude: float = 0.0,
        frequency_radps: float = 0.0,
    ) -> None:
        """Make a field.

        Args:
            profile: ν as (time s, value), ascending in time.
            stations: the phase (rad) of each station's drift.
            amplitude: of the drift.
            frequency_radps: of the drift.
        """
        self._times_s, self._values = np.array(profile).T
        self.stations: Final = MappingProxyType(dict(stations))
        self._amplitude: Final = amplitude
        self._frequency_radps: Final = frequency_radps

    @classmethod
    def of(cls, scenario: Scenario) -> Self | None:
        """Return the field of a scenario; ``None`` if it has none."""
        field = scenario.field
        if field is None:
            return None
        drift = field.drift
        return cls(field.profile, stations_of(scenario), drift.amplitude, drift.frequency_radps)

    @overload
    def value(self, time_s: float) -> float: ...

    @overload
    def value(self, time_s: NDArray[np.float64]) -> NDArray[np.float64]: ...

    def value(self, time_s: float | NDArray[np.float64]) -> float | NDArray[np.float64]:
        """Return ν: linear between the profile's points, constant before and after.

        Args:
            time_s: a time, or times float[...].

        Returns:
            A value for each time, in the same shape.
        """
        values = np.interp(time_s, self._times_s, self._values)
        return values if isinstance(time_s, np.ndarray) else float(values)

    @overload
    def reading(self, station: str, time_s: float) -> float: ...

    @overload
    def reading(self, station: str, time_s: NDArray[np.float64]) -> NDArray[np.float64]: ...

    def reading(
        self, station: str, time_s: float | NDArray[np.float64]
    ) -> float | NDArray[np.float64]:
        """Return what a station reads, without noise: ν and its drift.

        Args:
            station: one of ``stations``.
            time_s: a time, or times float[...].
        """
        angle_rad = self._frequency_radps * time_s + self.stations[station]
        read = self.value(time_s) + self._amplitude * np.sin(angle_rad)
        return read if isinstance(time_s, np.ndarray) else float(read)
