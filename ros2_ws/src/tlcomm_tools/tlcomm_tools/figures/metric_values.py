"""Rows of a comparison's table, as far as figures show them.

``Row``               a run's method, seed, swept value and metrics, by column
``MAIN_METRICS``      what figures show, of what there is, and what axes call it
``shown_metrics``     which of them rows have
``methods_of``        the methods in rows
``interval_of``       a metric's mean over rows
"""

from collections.abc import Iterable, Mapping, Sequence
from typing import Final

from tlcomm_tools.figures.intervals import Interval, mean_interval

__all__ = [
    "MAIN_METRICS",
    "Row",
    "interval_of",
    "methods_of",
    "shown_metrics",
]

Row = Mapping[str, object]
"""Columns by name; what isn't available is ``None``."""

MAIN_METRICS: Final[Mapping[str, str]] = {
    "additional_time_s": "additional time (s)",
    "makespan_s": "makespan (s)",
    "tasks_per_hour": "tasks (1/h)",
    "information_age_s": "age of information (s)",
    "deviation": "deviation from ν (–)",
    "distance_m": "distance driven (m)",
}


def shown_metrics(rows: Iterable[Row]) -> tuple[str, ...]:
    """Return the main metrics that some row has a value of."""
    known = {name for row in rows for name, value in row.items() if value is not None}
    return tuple(name for name in MAIN_METRICS if name in known)


def methods_of(rows: Iterable[Row]) -> tuple[str, ...]:
    """Return the methods in rows, in the order in which they first occur."""
    return tuple(dict.fromkeys(str(row["method"]) for row in rows))


def interval_of(rows: Sequence[Row], metric: str) -> Interval | None:
    """Return the mean of a metric over the rows that have it; ``None`` if none has."""
    values = [value for row in rows if isinstance(value := row.get(metric), int | float)]
    return mean_interval(values) if values else None
