"""What checks of a scenario find.

``Finding``       one thing wrong, and its place in the file
``did_you_mean``  what to use instead of an unknown name
"""

import difflib
from collections.abc import Collection
from dataclasses import dataclass

from tlcomm_core.scenario.document import Place

__all__ = ["Finding", "did_you_mean"]


@dataclass(frozen=True, slots=True)
class Finding:
    """Something wrong: where, what was found, and what was expected."""

    place: Place
    what: str


def did_you_mean(name: str, known: Collection[str]) -> str:
    """Return what to use instead of an unknown name."""
    close = difflib.get_close_matches(name, known, n=1)
    if close:
        return f"did you mean {close[0]!r}?"
    return f"expected one of {', '.join(sorted(known)[:20])}"
