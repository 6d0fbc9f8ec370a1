"""How simulated time goes on, as a user writes it."""

import pytest

from tlcomm_core.errors import InputError
from tlcomm_core.pace import Pace, parse_pace


@pytest.mark.parametrize(
    ("text", "factor"), [("lockstep", None), ("1.0", 1.0), ("2", 2.0), ("1e-1", 0.1)]
)
def test_pace_is_read(text: str, factor: float | None) -> None:
    """``lockstep`` and positive factors are paces, and are written as they can be read again."""
    pace = parse_pace(text)
    assert pace == Pace(factor)
    assert pace.is_lockstep == (factor is None)
    assert parse_pace(str(pace)) == pace


@pytest.mark.parametrize("text", ["", "fast", "0", "-1", "inf", "nan", "Lockstep", "1,5"])
def test_anything_else_is_refused(text: str) -> None:
    """What is no pace is quoted."""
    with pytest.raises(InputError, match=f"^pace: '{text}' "):
        parse_pace(text)
