"""The word that an agent's events tell.

``Letter``         the atoms that are true
``read_word``      a letter for the start, and one for each step
``cell_centre_m``  the centre of the cell that a point is in
"""

import math
from collections.abc import Sequence

import numpy as np

from tlcomm_core.records import TaskRecord
from tlcomm_core.scenario.model import Scenario, Workspace
from tlcomm_tools.audit.tracks import Track

__all__ = ["Letter", "cell_centre_m", "read_word"]

Letter = frozenset[str]
"""The atoms that are true."""


def read_word(
    scenario: Scenario, agent: str, steps: Sequence[TaskRecord], track: Track | None
) -> list[Letter]:
    """Return a letter for where the agent started, and one for each finished action or visit.

    A letter holds the action, if any, the region that the event names, and the regions in whose
    discs the centre of the agent's cell was: tasks are about cells, and an agent stands at a
    centre only to within its tolerance.

    Args:
        scenario: regions and starts.
        agent: whose.
        steps: its finished actions and visits, in order of time.
        track: where it was.
    """
    x_m, y_m, _ = scenario.agents[agent].start
    word = [_regions_at(scenario.workspace, x_m, y_m)]
    for record in steps:
        letter = frozenset({record.event.action, record.event.region} - {""})
        if track is not None:
            x_m, y_m = track.at(np.array([record.stamp_ns * 1e-9]))[0].tolist()
            letter |= _regions_at(scenario.workspace, x_m, y_m)
        word.append(letter)
    return word


def cell_centre_m(workspace: Workspace, x_m: float, y_m: float) -> tuple[float, float]:
    """Return the centre of the cell that a point is in."""
    x_m, y_m = (
        origin_m + (math.floor((own_m - origin_m) / workspace.cell_m) + 0.5) * workspace.cell_m
        for own_m, origin_m in zip((x_m, y_m), workspace.origin_m, strict=True)
    )
    return x_m, y_m


def _regions_at(workspace: Workspace, x_m: float, y_m: float) -> Letter:
    x_m, y_m = cell_centre_m(workspace, x_m, y_m)
    return frozenset(
        name
        for name, region in workspace.regions.items()
        if math.hypot(x_m - region.at_m[0], y_m - region.at_m[1]) <= region.radius_m
    )
