"""Whether agents kept out of what their tasks forbid."""

import numpy as np
import pytest

from support.danger_hall import danger_hall
from tlcomm_tools.audit.tracks import Track
from tlcomm_tools.audit.trespass import audit_trespass, forbidden_regions


@pytest.mark.parametrize(
    ("task", "found"),
    [
        ("G !danger & G F west", ["danger"]),
        ("G (!danger & !east)", ["east", "danger"]),
        ("!F danger", ["danger"]),
        ("G (east -> false)", ["east"]),
        ("G (danger -> load)", []),
        ("G (danger -> X west)", []),
        ("F G !danger", []),
        ("(G !danger) | G F west", []),
    ],
)
def test_the_regions_that_a_task_forbids(task: str, found: list[str]) -> None:
    """Only those in which it fails whatever the agent does there."""
    assert forbidden_regions(danger_hall(task), "careful") == found


def track(*points: tuple[float, float]) -> Track:
    """Return a track with a point each second."""
    return Track("careful", np.arange(len(points), dtype=float), np.array(points))


def test_a_way_through_the_danger_is_found() -> None:
    """Also between two samples outside of it, with when and how deep."""
    through = track((1.0, 0.5), (1.0, 2.6), (6.0, 2.6), (6.0, 3.0))
    assert list(audit_trespass(danger_hall(), "careful", through)) == [
        (
            "careful: 1.000 s: enters 'danger', which its task forbids always, "
            "and is up to 0.900 m inside"
        )
    ]


def test_a_way_past_it_and_who_does_not_mind_are_fine() -> None:
    """Its edge may be touched; standing outside is fine; another's task doesn't forbid it."""
    past = track((1.0, 1.7), (3.5, 1.7), (3.5, 1.7), (6.0, 1.7))
    assert list(audit_trespass(danger_hall(), "careful", past)) == []
    assert list(audit_trespass(danger_hall(), "bold", track((1.0, 2.6), (6.0, 2.6)))) == []
    assert list(audit_trespass(danger_hall(), "careful", None)) == []
