"""Whether agents kept out of the regions that their tasks forbid for ever.

``forbidden_regions``  which regions those are, for one agent
``audit_trespass``     where it entered one
"""

import math
from collections.abc import Collection, Iterator

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.scenario.model import Region, Scenario
from tlcomm_tools.audit.formula import Tree, read_formula
from tlcomm_tools.audit.tracks import Track

__all__ = ["audit_trespass", "forbidden_regions"]

# A track may touch a disc but for rounding.
_SLACK_M = 1e-6


def audit_trespass(scenario: Scenario, agent: str, track: Track | None) -> Iterator[str]:
    """Say which forbidden regions an agent's track leads through, and when first."""
    if track is None:
        return
    for name in forbidden_regions(scenario, agent):
        region = scenario.workspace.regions[name]
        depth_m = region.radius_m - _distances_m(track, region)
        inside = np.flatnonzero(depth_m > _SLACK_M)
        if len(inside):
            yield (
                f"{agent}: {track.times_s[inside[0]]:.3f} s: enters {name!r}, which its task "
                f"forbids always, and is up to {depth_m.max():.3f} m inside"
            )


def _distances_m(track: Track, region: Region) -> NDArray[np.float64]:
    """Return how near each straight between two samples comes to a region's middle."""
    offset_m = track.positions_m[:-1] - region.at_m
    step_m = np.diff(track.positions_m, axis=0)
    square = (step_m**2).sum(axis=1)
    share = np.clip(-(offset_m * step_m).sum(axis=1) / np.where(square > 0.0, square, 1.0), 0, 1)
    nearest_m = offset_m + share[:, None] * step_m
    distances_m: NDArray[np.float64] = np.hypot(nearest_m[:, 0], nearest_m[:, 1])
    return distances_m


def forbidden_regions(scenario: Scenario, agent: str) -> list[str]:
    """Return the regions in which some G β of the agent's task is false, whatever it does there.

    It may act, and be in regions that overlap; it isn't in any other.
    """
    parts = list(_always(read_formula(scenario.agents[agent].whole_task), inside=False))
    regions = scenario.workspace.regions
    found = []
    for name, region in regions.items():
        open_names = {
            other
            for other, that in regions.items()
            if math.dist(region.at_m, that.at_m) <= region.radius_m + that.radius_m
        } | scenario.actions_of(agent).keys()
        if any(not _may_hold(part, name, open_names - {name}) for part in parts):
            found.append(name)
    return found


def _always(tree: Tree, *, inside: bool) -> Iterator[Tree]:
    """Yield the parts that hold in every letter; those with operators of time are left out."""
    operator, *operands = tree
    if operator == "&":
        for operand in operands:
            yield from _always(operand, inside=inside)
    elif operator == "G":
        yield from _always(operands[0], inside=True)
    elif inside and _is_timeless(tree):
        yield tree


def _is_timeless(tree: Tree) -> bool:
    operator, *operands = tree
    if operator == "atom":
        return True
    return operator in {"!", "&", "|", "true", "false"} and all(map(_is_timeless, operands))


def _may_hold(tree: Tree, present: str, open_names: Collection[str]) -> bool:
    operator, *operands = tree
    if operator == "atom":
        return operands[0] == present or operands[0] in open_names
    if operator == "!":
        return bool(operands[0][1] != present)
    if operator in {"&", "|"}:
        values = [_may_hold(operand, present, open_names) for operand in operands]
        return all(values) if operator == "&" else any(values)
    return bool(operator == "true")
