"""Whether actions were done where they claim, and for as long as they take."""

import numpy as np
import pytest

from support.hand_made_run import hand_made_scenario, task
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_tools.audit.actions import audit_actions
from tlcomm_tools.audit.tracks import Track

# The region's middle, and 0.3 m is its radius.
LEFT = (1.25, 0.25)
AWAY = (2.25, 0.25)


def found(
    points: list[tuple[float, float]], *, action: str = "pick", until_s: float = 2.0
) -> list[str]:
    """Return what is wrong with an action from 1 s on, with a point each half second."""
    track = Track("west", 0.5 * np.arange(len(points)), np.array(points))
    where = {"region": "left", "action": action}
    events = [
        task(1.0, "west", TaskEventKind.ACTION_STARTED, **where),
        task(until_s, "west", TaskEventKind.ACTION_FINISHED, **where),
    ]
    return list(audit_actions(hand_made_scenario(), "west", events, track))


def test_who_stays_is_fine() -> None:
    """Before and afterwards it may be anywhere."""
    assert found([AWAY, AWAY, LEFT, LEFT, LEFT, AWAY]) == []


def test_who_leaves_for_a_while_is_named() -> None:
    """With region, time and distance, though it is there at both ends."""
    assert found([LEFT, LEFT, LEFT, AWAY, LEFT, LEFT]) == [
        "west: 1.000 s: leaves 'left' during 'pick', and is 1.000 m away until 2.000 s"
    ]


@pytest.mark.parametrize(
    ("points", "time_s"),
    [([LEFT, LEFT, AWAY, LEFT, LEFT], 1.0), ([LEFT, LEFT, LEFT, LEFT, AWAY], 2.0)],
)
def test_who_begins_or_ends_elsewhere_is_named_once(
    points: list[tuple[float, float]], time_s: float
) -> None:
    """By the time at which it wasn't there."""
    assert found(points) == [
        f"west: {time_s:.3f} s: 'pick' done 1.000 m from 'left', whose radius is 0.3 m"
    ]


def test_too_short_and_unknown_actions_are_named() -> None:
    """Picking takes a second; there is no action to dance."""
    stay = [LEFT] * 6
    assert found(stay, until_s=1.75) == ["west: 1.750 s: 'pick' took 0.750 s, not 1 s"]
    assert found(stay, action="dance") == ["west: 2.000 s: no action 'dance'"]
