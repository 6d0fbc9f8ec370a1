"""What a scenario demands of meetings, and whether its cells leave room for it.

``check_meetings``  what is wrong with it
"""

import math
from collections.abc import Iterator
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.scenario.finding import Finding
from tlcomm_core.scenario.model import Scenario

__all__ = ["check_meetings"]

_ROUNDING_M: Final = 1e-9
# The nearest of the places around one: if no two of them make a triangle with it, others hardly do.
_TRIED: Final = 300


def check_meetings(scenario: Scenario) -> Iterator[Finding]:
    """Say what is wrong with the places and times that meetings may have."""
    communication = scenario.communication
    if communication.margin_s >= communication.period_s:
        yield Finding(
            ("communication", "margin_s"),
            f"{communication.margin_s!r} isn't shorter than period_s"
            f" ({communication.period_s!r}): no time is left for a meeting",
        )
    separation_m = communication.separation_m
    planned_m = communication.range_m - 2.0 * scenario.position_tolerance_m
    if separation_m >= planned_m > 0.0:
        yield Finding(
            ("communication", "separation_m"),
            f"{separation_m!r} isn't less than what links are planned with, {planned_m:.9g} m:"
            f" range_m ({communication.range_m!r}) less twice the largest position_tolerance_m",
        )
    elif separation_m and len(scenario.agents) > 1:
        yield from _room(scenario, planned_m)


def _room(scenario: Scenario, planned_m: float) -> Iterator[Finding]:
    """Say whether enough cells' centres can be linked although they are far enough apart."""
    communication, cell_m = scenario.communication, scenario.workspace.cell_m
    around_m = _linked_offsets_m(cell_m, communication.separation_m, planned_m)
    fits = len(around_m) > 0
    count = 2
    if fits and communication.resilience and len(scenario.agents) > count:
        count = 3
        fits = _has_triangle(around_m, communication.separation_m, planned_m)
    if not fits:
        yield Finding(
            ("communication", "separation_m"),
            f"{communication.separation_m!r} leaves no {count} cells' centres, {cell_m!r} m apart"
            f" along x and y, within {planned_m:.9g} m of each other; choose another separation_m,"
            " a smaller cell_m or a larger range_m",
        )


def _linked_offsets_m(cell_m: float, separation_m: float, planned_m: float) -> NDArray[np.float64]:
    """Return the nearest places around one that it can be linked to, float[M, 2]."""
    # Enough cells for a ring of the separation's radius, and at least one beyond.
    reach = math.floor(min(planned_m, separation_m + 2.0 * cell_m) / cell_m + _ROUNDING_M)
    steps = np.arange(-reach, reach + 1) * cell_m
    offsets_m = np.stack(np.meshgrid(steps, steps), axis=-1).reshape(-1, 2)
    linked_m = offsets_m[_is_linked(offsets_m, separation_m, planned_m)]
    order = np.argsort(np.hypot(linked_m[:, 0], linked_m[:, 1]), kind="stable")
    nearest_m: NDArray[np.float64] = linked_m[order[:_TRIED]]
    return nearest_m


def _has_triangle(around_m: NDArray[np.float64], separation_m: float, planned_m: float) -> bool:
    between_m = around_m[:, None] - around_m[None]
    return bool(_is_linked(between_m, separation_m, planned_m).any())


def _is_linked(
    offsets_m: NDArray[np.float64], separation_m: float, planned_m: float
) -> NDArray[np.bool_]:
    length_m = np.hypot(offsets_m[..., 0], offsets_m[..., 1])
    return (length_m >= separation_m - _ROUNDING_M) & (length_m <= planned_m + _ROUNDING_M)
