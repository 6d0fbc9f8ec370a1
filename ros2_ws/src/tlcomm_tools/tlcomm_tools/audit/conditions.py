"""Whether actions were performed where, and after what, the scenario lets them be.

``audit_conditions``  which were not
"""

import math
from collections import defaultdict
from collections.abc import Iterator, Sequence

import numpy as np

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.records import TaskRecord
from tlcomm_core.scenario.model import Scenario
from tlcomm_tools.audit.tracks import Track

__all__ = ["audit_conditions"]

_PLACE_SLACK_M = 1e-6


def audit_conditions(
    scenario: Scenario, agent: str, events: Sequence[TaskRecord], track: Track | None
) -> Iterator[str]:
    """Say which of an agent's finished actions lacked what they need first.

    Args:
        scenario: regions and actions.
        agent: whose.
        events: the agent's own, in order of time.
        track: where it was.
    """
    conditional = scenario.conditional_actions_of(agent)
    # By action, what has been performed since it was.
    since: defaultdict[str, set[str]] = defaultdict(set)
    for record in events:
        name = record.event.action
        if record.event.kind is not TaskEventKind.ACTION_FINISHED or not name:
            continue
        time_s = record.stamp_ns * 1e-9
        if name in conditional:
            at, after = conditional[name].at, conditional[name].after
            if at is not None and track is not None and not _is_in(scenario, at, track, time_s):
                yield f"{agent}: {time_s:.3f} s: {name!r} done outside of {', '.join(at)}"
            missing = [other for other in after if other not in since[name]]
            if missing:
                yield f"{agent}: {time_s:.3f} s: {name!r} done without {', '.join(missing)} before"
        since[name] = set()
        for other in conditional:
            if other != name:
                since[other].add(name)


def _is_in(scenario: Scenario, names: Sequence[str], track: Track, time_s: float) -> bool:
    # The slack is that of an agent at a cell's centre on the very edge of a region.
    slack_m = scenario.drive_of(track.agent).position_tolerance_m + _PLACE_SLACK_M
    x_m, y_m = track.at(np.array([time_s]))[0]
    regions = (scenario.workspace.regions[name] for name in names)
    return any(
        math.dist(region.at_m, (x_m, y_m)) <= region.radius_m + slack_m for region in regions
    )
