"""Whether actions had what they need first."""

import numpy as np
import pytest

from support.danger_hall import danger_hall
from support.hand_made_run import task
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_tools.audit.conditions import audit_conditions
from tlcomm_tools.audit.tracks import Track

HALL = danger_hall(actions="load: 2.0, weigh: {duration_s: 1.0, at: [east], after: [load]}")
EAST = (6.25, 2.75)
WEST = (0.75, 2.75)


@pytest.mark.parametrize(
    ("steps", "found"),
    [
        ([("load", WEST), ("weigh", EAST), ("load", WEST), ("weigh", EAST)], []),
        ([("load", WEST), ("load", WEST), ("weigh", EAST)], []),
        ([("weigh", EAST)], ["careful: 0.000 s: 'weigh' done without load before"]),
        (
            [("load", WEST), ("weigh", EAST), ("weigh", EAST)],
            ["careful: 2.000 s: 'weigh' done without load before"],
        ),
        ([("load", WEST), ("weigh", WEST)], ["careful: 1.000 s: 'weigh' done outside of east"]),
    ],
)
def test_actions_without_what_they_need(
    steps: list[tuple[str, tuple[float, float]]], found: list[str]
) -> None:
    """Each is named with its time and what was missing."""
    events = [
        task(float(time_s), "careful", TaskEventKind.ACTION_FINISHED, action=action)
        for time_s, (action, _) in enumerate(steps)
    ]
    track = Track("careful", np.arange(len(steps) + 1.0), np.array([*(p for _, p in steps), EAST]))
    assert list(audit_conditions(HALL, "careful", events, track)) == found
