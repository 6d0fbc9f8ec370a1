"""What methods are compared by: figures of a run's result, as its metrics define them.

``Measure``     what a figure is called
``MEASURES``    all of them, by key
``figures_of``  those of a run
"""

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Any, Final

__all__ = ["MEASURES", "Measure", "figures_of"]


@dataclass(frozen=True, slots=True)
class Measure:
    """What a figure is called, and with how many digits it is shown.

    Attributes:
        label: for people, with the unit.
        digits: after the point.
    """

    label: str
    digits: int = 2


MEASURES: Final[Mapping[str, Measure]] = MappingProxyType(
    {
        "windows": Measure("windows", 0),
        "satisfied": Measure("windows kept", 0),
        "missed": Measure("windows missed", 0),
    }
)


def figures_of(result: Mapping[str, Any]) -> dict[str, float | None]:
    """Return all measures of a result document; ``None`` where it has none."""
    return {key: result["communication"][key] for key in MEASURES}
