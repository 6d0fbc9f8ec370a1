"""A promise of a method, and what was found of it.

``Guarantee``  both
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

__all__ = ["Guarantee"]


@dataclass(frozen=True, slots=True)
class Guarantee:
    """A promise of a method, and what was found of it.

    Attributes:
        promise: in a few words.
        shown: what was found for people: by label, in order.
        figures: the same as numbers, by names that carry their units.
        violations: where it was broken, a line each.
    """

    promise: str
    shown: Mapping[str, str]
    figures: Mapping[str, float | None]
    violations: tuple[str, ...]

    def document(self) -> dict[str, Any]:
        """Return it ready for ``json.dumps``."""
        return {"promise": self.promise, "kept": not self.violations, **self.figures}
