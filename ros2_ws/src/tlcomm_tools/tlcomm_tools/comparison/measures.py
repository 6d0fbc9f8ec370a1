"""What methods are compared by: the team's metrics, as results have them.

``MEASURES``    their keys
``SHOWN``       those that tables and figures show, and how
``Measure``     how one is shown
``figures_of``  all of a run
"""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from types import MappingProxyType
from typing import Any, Final

from tlcomm_core.metrics.summary import Computing, TeamMetrics

__all__ = ["MEASURES", "SHOWN", "Measure", "figures_of"]

MEASURES: Final = (
    *(own.name for own in fields(TeamMetrics)),
    *(own.name for own in fields(Computing)),
    "wall_s",
)
"""The metrics of the team, of computing, and the wall time of the whole run."""


@dataclass(frozen=True, slots=True)
class Measure:
    """How tables and figures show a measure.

    Attributes:
        label: for people, with the unit.
        digits: after the point.
    """

    label: str
    digits: int


SHOWN: Final[Mapping[str, Measure]] = MappingProxyType(
    {
        "additional_s": Measure("additional time (s)", 2),
        "lost_per_window_s": Measure("lost per window (s)", 2),
        "makespan_sum_s": Measure("sum of makespans (s)", 1),
        "tasks_per_hour": Measure("tasks per hour", 1),
        "meetings": Measure("meetings", 1),
        "windows_kept": Measure("windows kept", 1),
        "windows_missed": Measure("windows missed", 1),
        "information_age_mean_s": Measure("age of information (s)", 1),
        "deviation_mean": Measure("mean deviation", 3),
        "deviation_max": Measure("largest deviation", 3),
        "deviation_settled_max": Measure("largest once settled", 3),
        "distance_m": Measure("distance (m)", 0),
        "messages": Measure("messages", 0),
        "bytes": Measure("bytes", 0),
        "solve_wall_s": Measure("solving (s)", 4),
        "wall_s": Measure("wall time (s)", 1),
    }
)


def figures_of(result: Mapping[str, Any]) -> dict[str, float | None]:
    """Return all measures of a result document; ``None`` where it has none."""
    metrics = result["metrics"]
    found = {**metrics["team"], **metrics["computing"], "wall_s": result["wall_s"]}
    return {key: found[key] for key in MEASURES}
