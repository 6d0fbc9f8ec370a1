"""Tests of ``tlcomm_tools.figures.measured``."""

from typing import Any

from tlcomm_tools.comparison.measures import SHOWN
from tlcomm_tools.figures.measured import MAIN, Mark, measured

KEY = MAIN[0]


def estimate(mean: float, low: float | None = None, high: float | None = None) -> dict[str, Any]:
    """Return a mean as a comparison's document has it."""
    return {"mean": mean, "low": low, "high": high, "count": 1 if low is None else 9}


def document(**means: Any) -> dict[str, Any]:  # noqa: ANN401 - JSON
    """Return a document with these means of one measure by method."""
    return {
        "measures": {KEY: {"label": "wait (s)", "digits": 2}},
        "points": [{"value": None, "means": {name: {KEY: own} for name, own in means.items()}}],
    }


def test_a_mark_has_its_interval() -> None:
    """As far as it reaches to either side of the mean; a single seed has none."""
    (own,) = measured(document(team=estimate(3.0, 2.0, 5.0), none=estimate(4.0)))
    assert own.label == "wait (s)"
    assert own.marks == {"team": (Mark(None, 3.0, 1.0, 2.0),), "none": (Mark(None, 4.0, 0.0, 0.0),)}


def test_an_interval_beside_its_mean_ends_there() -> None:
    """An interval that is corrected for its bias may lie beside the mean."""
    (own,) = measured(document(team=estimate(3.0, 3.5, 5.0), none=estimate(4.0)))
    assert own.marks["team"] == (Mark(None, 3.0, 0.0, 2.0),)


def test_what_a_method_does_not_have_has_no_mark() -> None:
    """It keeps its place among the methods, which are in the order of all figures."""
    (own,) = measured(document(team=estimate(3.0), none=None, static=estimate(4.0)))
    assert list(own.marks) == ["team", "static", "none"]
    assert own.marks["none"] == ()


def test_what_is_the_same_for_all_is_left_out() -> None:
    """As what nobody has."""
    assert measured(document(team=estimate(3.0), none=estimate(3.0))) == ()
    assert measured(document(team=None)) == ()


def test_what_is_drawn_is_what_comparisons_have() -> None:
    """Each by its key; what else they have is left to tables."""
    assert set(MAIN) < SHOWN.keys()
    found = document(team=estimate(3.0), none=estimate(4.0))
    found["measures"] = {"wall_s": found["measures"][KEY]}
    assert measured(found) == ()
