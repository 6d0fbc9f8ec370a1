"""Tests of ``tlcomm_tools.replay.quality``."""

import pytest

from tlcomm_core.errors import InputError
from tlcomm_tools.bag.metadata import qos_text
from tlcomm_tools.replay.quality import Quality, read_quality


@pytest.mark.parametrize(
    ("latched", "expected"),
    [(False, Quality(1000)), (True, Quality(10, latched=True))],
)
def test_our_own_profiles(latched: bool, expected: Quality) -> None:
    """What the recorder writes is read back."""
    assert read_quality(qos_text(latched=latched)) == expected


@pytest.mark.parametrize(
    ("profiles", "expected"),
    [
        ("", Quality(10)),
        ("[]", Quality(10)),
        ("[{history: 1, depth: 5, reliability: 2, durability: 2}]", Quality(5, reliable=False)),
        ("[{history: keep_all, reliability: 1, durability: 1}]", Quality(None, latched=True)),
        (
            "[{depth: 3, reliability: best_effort}, {depth: 7, reliability: reliable}]",
            Quality(7),
        ),
    ],
)
def test_other_recorders_profiles(profiles: str, expected: Quality) -> None:
    """None at all, rmw's numbers, everything kept, and the better of two publishers."""
    assert read_quality(profiles) == expected


@pytest.mark.parametrize("profiles", ["[1]", "{", "7", "[{depth: many}]", "[" * 100_000])
def test_nonsense_is_refused(profiles: str) -> None:
    """What is no list of profiles is quoted."""
    with pytest.raises(InputError, match="offered_qos_profiles can't be read"):
        read_quality(profiles)
