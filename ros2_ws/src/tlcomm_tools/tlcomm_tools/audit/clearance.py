"""Whether agents kept clear of obstacles, which come and go, and inside of the workspace.

``audit_clearance``  where one didn't
"""

import math
from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.scenario.model import Workspace
from tlcomm_tools.audit.sight import Box, hidden
from tlcomm_tools.audit.tracks import Track

__all__ = ["audit_clearance", "obstacles_of"]

# What a track may enter an obstacle by through rounding.
_SLACK_M: Final = 1e-6


def obstacles_of(workspace: Workspace) -> tuple[tuple[float, tuple[Box, ...]], ...]:
    """Return from when on which obstacles stand, ascending from 0 s."""
    later = ((change.at_s, change.obstacles_m) for change in workspace.changes)
    return ((0.0, workspace.obstacles_m), *later)


def audit_clearance(workspace: Workspace, track: Track | None) -> Iterator[str]:
    """Say when an agent was first in each obstacle, and when outside of the workspace.

    Whom an obstacle appears on may get out of it: it counts from the first sample outside on.

    Args:
        workspace: with its changes.
        track: where the agent was, if that is known.
    """
    if track is None:
        return
    yield from _strays(workspace, track)
    maps = (*obstacles_of(workspace), (math.inf, ()))
    for (from_s, boxes), (to_s, _) in pairwise(maps):
        end_s = min(to_s, float(track.times_s[-1]))
        if from_s <= end_s:
            yield from _intrusions(track, (from_s, end_s), boxes)


def _strays(workspace: Workspace, track: Track) -> Iterator[str]:
    low_m = np.array(workspace.origin_m)
    high_m = low_m + workspace.size_m
    beyond_m = np.maximum(low_m - track.positions_m, track.positions_m - high_m).max(axis=1)
    outside = np.flatnonzero(beyond_m > _SLACK_M)
    if len(outside):
        yield (
            f"{track.agent}: {track.times_s[outside[0]]:.3f} s: leaves the workspace, and is up to "
            f"{beyond_m.max():.3f} m outside"
        )


def _intrusions(track: Track, span_s: tuple[float, float], boxes: Sequence[Box]) -> Iterator[str]:
    """Say when a track first leads through each box while they stand."""
    begin_s, end_s = span_s
    between = (track.times_s > begin_s) & (track.times_s < end_s)
    times_s = np.array([begin_s, *track.times_s[between], end_s])
    places_m = track.at(times_s)
    if begin_s > 0.0:
        free = np.flatnonzero(~_inside(places_m, boxes))
        out = free[0] if len(free) else len(times_s)
        times_s, places_m = times_s[out:], places_m[out:]
    for box in boxes:
        touched = _touched(places_m, box)
        if len(touched):
            x_m, y_m = places_m[touched[0]]
            corners = ", ".join(f"{value:g}" for value in box)
            yield (
                f"{track.agent}: {times_s[touched[0]]:.3f} s: in the obstacle [{corners}], "
                f"at ({x_m:.3f}, {y_m:.3f}) m"
            )


def _inside(places_m: NDArray[np.float64], boxes: Sequence[Box]) -> NDArray[np.bool_]:
    """Tell which places are inside of any box."""
    inside = np.zeros(len(places_m), dtype=np.bool_)
    for x_min, y_min, x_max, y_max in boxes:
        low_m = np.array((x_min, y_min)) + _SLACK_M
        high_m = np.array((x_max, y_max)) - _SLACK_M
        inside |= ((places_m > low_m) & (places_m < high_m)).all(axis=1)
    return inside


def _touched(places_m: NDArray[np.float64], box: Box) -> NDArray[np.intp]:
    """Return the samples, ascending, that are inside of a box, or come from across it."""
    touched = _inside(places_m, [box])
    if len(places_m) > 1:
        low_m = np.minimum(places_m[:-1], places_m[1:])
        high_m = np.maximum(places_m[:-1], places_m[1:])
        near = ((low_m < box[2:]) & (high_m > box[:2])).all(axis=1)
        near = np.flatnonzero(near)
        touched[near + 1] |= hidden(places_m[near], places_m[near + 1], [box])
    return np.flatnonzero(touched)
