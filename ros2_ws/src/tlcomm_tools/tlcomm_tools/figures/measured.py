"""What a comparison found, as far as it is drawn.

``Mark``       a mean over seeds, at a value of what is varied
``Measured``   a measure of all methods
``MAIN``       the measures that are drawn; the rest is in tables
``measured``   those of a comparison's document by which methods or values differ
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

from tlcomm_tools.figures.style import in_order

__all__ = ["MAIN", "Mark", "Measured", "measured"]

MAIN: Final = (
    "additional_s",
    "lost_per_window_s",
    "makespan_sum_s",
    "tasks_per_hour",
    "information_age_mean_s",
    "windows_kept",
    "deviation_mean",
    "deviation_settled_max",
    "bytes",
)


@dataclass(frozen=True, slots=True)
class Mark:
    """A mean over seeds.

    Attributes:
        value: of what is varied; ``None`` if nothing is.
        mean: of the measure.
        below: from the lower end of its interval to the mean; 0 of a single seed.
        above: from the mean to the upper end; 0 of a single seed.
    """

    value: float | None
    mean: float
    below: float
    above: float


@dataclass(frozen=True, slots=True)
class Measured:
    """A measure of all methods.

    Attributes:
        label: for an axis, with the unit.
        marks: of each method, in the order of values; none where it doesn't have the measure.
    """

    label: str
    marks: Mapping[str, tuple[Mark, ...]]


def measured(found: Mapping[str, Any]) -> tuple[Measured, ...]:
    """Return the main measures by which methods or values differ.

    Args:
        found: a comparison's document, ``tlcomm-compare/1``.
    """
    labels = {key: own["label"] for key, own in found["measures"].items()}
    known = (_measured(found, key, labels[key]) for key in MAIN if key in labels)
    return tuple(measure for measure in known if _differs(measure))


def _measured(found: Mapping[str, Any], key: str, label: str) -> Measured:
    methods = {method for point in found["points"] for method in point["means"]}
    return Measured(
        label,
        {
            method: tuple(
                _mark(point["value"], estimate)
                for point in found["points"]
                if (estimate := point["means"].get(method, {}).get(key)) is not None
            )
            for method in in_order(methods)
        },
    )


def _mark(value: float | None, estimate: Mapping[str, Any]) -> Mark:
    mean = estimate["mean"]
    if estimate["low"] is None:
        return Mark(value, mean, 0.0, 0.0)
    # The mean itself may lie outside of an interval that is corrected for its bias.
    below, above = mean - estimate["low"], estimate["high"] - mean
    return Mark(value, mean, max(below, 0.0), max(above, 0.0))


def _differs(measure: Measured) -> bool:
    return len({mark.mean for marks in measure.marks.values() for mark in marks}) > 1
