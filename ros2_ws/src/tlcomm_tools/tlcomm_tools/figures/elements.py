"""What a trace is made of.

``Element``         what they have in common: frozen, checked, ready for JSON
``Ground``          the workspace
``Path``            where an agent was when
``Series``          a value that holds until the next one
``Profile``         a value that is straight between others
``Activity``        what an agent does in a ``Span`` of time
``Meeting``         where a team, or a part of it, agreed to meet, and who was linked there
``AdditionalTime``  what a round cost each agent
``Agreement``       the cost that a round began and ended with
``Course``          the same after each move
"""

from collections.abc import Sequence
from enum import StrEnum
from itertools import pairwise
from typing import Annotated, Self

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field, model_validator

__all__ = [
    "Activity",
    "AdditionalTime",
    "Agreement",
    "Course",
    "Element",
    "Ground",
    "Meeting",
    "Path",
    "Profile",
    "Series",
    "Span",
]

Round = Annotated[int, Field(ge=0)]
Point = tuple[float, float]


class Element(BaseModel):
    """Frozen, and checked when it is made or read."""

    model_config = ConfigDict(strict=True, frozen=True, extra="forbid", allow_inf_nan=False)


class Ground(Element):
    """The workspace: obstacles (x_min, y_min, x_max, y_max) and regions (x, y, radius)."""

    origin_m: Point
    size_m: Point
    cell_m: float
    obstacles_m: tuple[tuple[float, float, float, float], ...]
    regions_m: dict[str, tuple[float, float, float]]


class Path(Element):
    """Where an agent was when; straight in between."""

    times_s: tuple[float, ...]
    x_m: tuple[float, ...]
    y_m: tuple[float, ...]

    @model_validator(mode="after")
    def _check(self) -> Self:
        if not len(self.times_s) == len(self.x_m) == len(self.y_m):
            raise ValueError("times_s, x_m and y_m differ in length")
        _check_ascending(self.times_s)
        return self

    def between(self, start_s: float, end_s: float) -> NDArray[np.float64]:
        """Return the places [N, 2] from one time to another, both ends among them."""
        inner = [time_s for time_s in self.times_s if start_s < time_s < end_s]
        times_s = [start_s, *inner, end_s]
        return np.column_stack(
            [np.interp(times_s, self.times_s, own) for own in (self.x_m, self.y_m)]
        )


class _Valued(Element):
    times_s: tuple[float, ...]
    values: tuple[float, ...]

    @model_validator(mode="after")
    def _check(self) -> Self:
        if len(self.times_s) != len(self.values):
            raise ValueError("times_s and values differ in length")
        _check_ascending(self.times_s)
        return self


class Profile(_Valued):
    """A value that is straight between others, and constant before and after them."""

    def at(self, times_s: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the value at some times [T], fresh."""
        return np.interp(times_s, self.times_s, self.values)


class Series(_Valued):
    """A value that holds until the next one."""

    def at(self, times_s: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the value at some times [T], fresh; NaN before the first one."""
        last = np.searchsorted(self.times_s, times_s, side="right") - 1
        values: NDArray[np.float64] = np.array([*self.values, np.nan])[last]
        return values


class Activity(StrEnum):
    """What an agent does when it isn't under way."""

    ACTION = "action"
    WAIT = "wait"
    MEETING = "meeting"


class Span(Element):
    """A stretch of time in which an agent does one thing.

    Attributes:
        activity: what.
        action: which one, or "".
        start_s: from.
        end_s: to.
    """

    activity: Activity
    action: str
    start_s: float
    end_s: float


class Meeting(Element):
    """A meeting that took place, of the whole team or a part of it.

    Attributes:
        round: whose meeting it is.
        start_s: when it began.
        places_m: where each of those who met was to be.
        links: who of them heard whom, by name, each pair in the order of the team.
    """

    round: Round
    start_s: float
    places_m: dict[str, Point]
    links: tuple[tuple[str, str], ...]


class AdditionalTime(Element):
    """ξ of a round, of each agent that it is known of."""

    round: Round
    by_agent_s: Annotated[dict[str, float], Field(min_length=1)]

    @property
    def mean_s(self) -> float:
        """The mean over agents."""
        return sum(self.by_agent_s.values()) / len(self.by_agent_s)


class Agreement(Element):
    """Φ of the team strategy that a round's coordination began with, and of the agreed one."""

    round: Round
    initial_s: float
    agreed_s: float


class Course(Element):
    """Φ of S⁰ and after each move of Algorithm 1."""

    round: Round
    potentials_s: Annotated[tuple[float, ...], Field(min_length=1)]


def _check_ascending(times_s: Sequence[float]) -> None:
    if any(later < earlier for earlier, later in pairwise(times_s)):
        raise ValueError("times_s isn't ascending")
