"""Whether agents kept clear of obstacles and inside of the workspace."""

import numpy as np
import pytest

from support.hand_made_run import hand_made_scenario
from tlcomm_core.scenario.model import Change, Workspace
from tlcomm_tools.audit.clearance import audit_clearance
from tlcomm_tools.audit.sight import Box
from tlcomm_tools.audit.tracks import Track

PILLAR = (3.0, 0.0, 4.0, 0.5)
Points = list[tuple[float, float]]


def found(points: Points, boxes: tuple[Box, ...], *changes: Change) -> list[str]:
    """Return what is wrong with a way of a point each second, in a hall of 8 m by 1 m."""
    update = {"obstacles_m": boxes, "changes": changes}
    workspace: Workspace = hand_made_scenario().workspace.model_copy(update=update)
    track = Track("west", np.arange(float(len(points))), np.array(points))
    return list(audit_clearance(workspace, track))


@pytest.mark.parametrize(
    ("points", "lines"),
    [
        ([(2.0, 0.5), (5.0, 0.5), (5.0, 0.0)], []),
        ([(2.0, 0.2), (3.0, 0.2), (3.0, 0.2)], []),
        (
            [(2.0, 0.2), (3.5, 0.2), (3.5, 0.2)],
            ["west: 1.000 s: in the obstacle [3, 0, 4, 0.5], at (3.500, 0.200) m"],
        ),
        (
            [(2.0, 0.2), (2.5, 0.2), (5.0, 0.2)],
            ["west: 2.000 s: in the obstacle [3, 0, 4, 0.5], at (5.000, 0.200) m"],
        ),
        (
            [(3.5, 0.2), (3.5, 0.2)],
            ["west: 0.000 s: in the obstacle [3, 0, 4, 0.5], at (3.500, 0.200) m"],
        ),
        (
            [(0.1, 0.2), (-0.2, 0.2), (0.1, 0.2)],
            ["west: 1.000 s: leaves the workspace, and is up to 0.200 m outside"],
        ),
    ],
)
def test_a_wall_in_the_way(points: Points, lines: list[str]) -> None:
    """It may be touched, but neither entered nor crossed; the same for the hall's border."""
    assert found(points, (PILLAR,)) == lines


def test_obstacles_come_and_go() -> None:
    """Each counts while it stands; whom it appears on may leave it, but not come back."""
    appears = Change(at_s=1.5, obstacles_m=(PILLAR,))
    goes = Change(at_s=2.1, obstacles_m=())
    assert found([(2.0, 0.2), (5.0, 0.2), (5.0, 0.2)], (), appears) == []
    assert found([(5.0, 0.2), (5.0, 0.2), (5.0, 0.2), (2.0, 0.2)], (), appears, goes) == []
    caught: Points = [(2.0, 0.2), (3.5, 0.2), (3.5, 0.2), (5.0, 0.2), (5.0, 0.2)]
    assert found(caught, (), appears) == []
    assert found([*caught, (3.5, 0.2)], (), appears) == [
        "west: 5.000 s: in the obstacle [3, 0, 4, 0.5], at (3.500, 0.200) m"
    ]
    assert len(found(caught, (PILLAR,), appears)) == 1


def test_without_a_track_nothing_is_said() -> None:
    """That it is missing, others say."""
    assert list(audit_clearance(hand_made_scenario().workspace, None)) == []
