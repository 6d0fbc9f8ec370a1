"""What a scenario's fields must mean together.

``check``           all findings of a scenario
``check_formulas``  those of its tasks' texts alone
"""

from collections.abc import Collection, Iterator, Sequence
from itertools import pairwise
from typing import Final

import numpy as np
from scipy.sparse.csgraph import connected_components

from tlcomm_core.errors import FormulaError, InputError
from tlcomm_core.ltl.formula import atoms
from tlcomm_core.ltl.parser import explain, parse
from tlcomm_core.scenario.conditions import check_conditions
from tlcomm_core.scenario.document import Place
from tlcomm_core.scenario.finding import Finding, did_you_mean
from tlcomm_core.scenario.measurements import check_field
from tlcomm_core.scenario.meetings import check_meetings
from tlcomm_core.scenario.model import Agent, Scenario, Workspace
from tlcomm_core.scenario.site import grid_of, later_grids, region_location
from tlcomm_core.scenario.task import read_automaton
from tlcomm_core.workspace.grid import Box, Grid
from tlcomm_core.workspace.sight import sightlines

__all__ = ["MAX_CELLS", "check", "check_formulas"]

MAX_CELLS: Final = 1_000_000
# Names of topics and nodes beside which an agent's namespace would be taken for something else.
_TAKEN_NAMES: Final = frozenset(
    {"clock", "connectivity", "parameter_events", "recorder", "rosout", "sim", "tf", "tf_static"}
)


def check(scenario: Scenario) -> list[Finding]:
    """Return what is wrong with a scenario whose fields are well-formed; empty if nothing.

    Cost: O(regions · Z + agents²).
    """
    findings = [*_timing(scenario), *_extent(scenario.workspace), *_names(scenario)]
    findings += _changes(scenario.workspace)
    if findings:
        return findings
    findings += check_meetings(scenario)
    grid = grid_of(scenario.workspace)
    findings += _regions(scenario.workspace, grid)
    findings += _closed_regions(scenario.workspace)
    findings += _starts(scenario, grid)
    findings += check_conditions(scenario)
    findings += check_field(scenario)
    findings += _tasks(scenario)
    if findings:
        return findings
    return [*_connectivity(scenario, grid), *_reachability(scenario, grid)]


def check_formulas(scenario: Scenario) -> list[Finding]:
    """Return what is wrong with the texts of the agents' tasks; empty if nothing."""
    return [*_tasks(scenario)]


def _timing(scenario: Scenario) -> Iterator[Finding]:
    communication = scenario.communication
    if communication.duration_s >= communication.period_s:
        yield Finding(
            ("communication", "duration_s"),
            f"{communication.duration_s!r} isn't shorter than period_s"
            f" ({communication.period_s!r}); expected D_c < T_c",
        )
    if communication.hop_latency_s >= communication.duration_s:
        yield Finding(
            ("communication", "hop_latency_s"),
            f"{communication.hop_latency_s!r} isn't shorter than duration_s"
            f" ({communication.duration_s!r})",
        )
    slowest_s = communication.hop_latency_s + scenario.radio.jitter_s
    if communication.hop_latency_s < communication.duration_s <= slowest_s:
        yield Finding(
            ("radio", "jitter_s"),
            f"{scenario.radio.jitter_s!r} more than hop_latency_s isn't shorter than duration_s"
            f" ({communication.duration_s!r}): messages would outlast every meeting",
        )
    tolerance_m = scenario.position_tolerance_m
    if communication.range_m <= 2.0 * tolerance_m:
        yield Finding(
            ("communication", "range_m"),
            f"{communication.range_m!r} isn't more than twice the largest position_tolerance_m"
            f" ({tolerance_m!r})",
        )


def _extent(workspace: Workspace) -> Iterator[Finding]:
    columns, rows = (length_m / workspace.cell_m for length_m in workspace.size_m)
    if min(columns, rows) < 1.0 or columns * rows > MAX_CELLS:
        yield Finding(
            ("workspace", "cell_m"),
            f"{workspace.cell_m!r} makes {columns:.6g} x {rows:.6g} cells of size_m;"
            f" expected at least 1 x 1 and at most {MAX_CELLS} in all",
        )
    yield from _boxes(("workspace", "obstacles_m"), workspace.obstacles_m)


def _boxes(place: Place, boxes: Sequence[Box]) -> Iterator[Finding]:
    for index, (x_min, y_min, x_max, y_max) in enumerate(boxes):
        if x_min >= x_max or y_min >= y_max:
            yield Finding(
                (*place, index),
                f"{[x_min, y_min, x_max, y_max]!r} is no box;"
                " expected x_min, y_min, x_max, y_max with min < max",
            )


def _changes(workspace: Workspace) -> Iterator[Finding]:
    for index, change in enumerate(workspace.changes):
        yield from _boxes(("workspace", "changes", index, "obstacles_m"), change.obstacles_m)
    for index, (change, following) in enumerate(pairwise(workspace.changes), start=1):
        if following.at_s <= change.at_s:
            yield Finding(
                ("workspace", "changes", index, "at_s"),
                f"{following.at_s!r} isn't later than the change before ({change.at_s!r});"
                " expected ascending times",
            )


def _names(scenario: Scenario) -> Iterator[Finding]:
    regions = scenario.workspace.regions
    places: list[tuple[str, ...]] = [("workspace", "regions", name) for name in regions]
    places += [("actions", name) for name in scenario.actions]
    for agent, fields in scenario.agents.items():
        places += [("agents", agent, "actions", name) for name in fields.actions]
        if agent.lower() in _TAKEN_NAMES:
            yield Finding(("agents", agent), f"the name {agent!r} is taken; choose another")
    for place in places:
        name = str(place[-1])
        if not _is_atom(name):
            yield Finding(place, f"the name {name!r} is an operator of formulas; choose another")
        if place[0] != "workspace" and name in regions:
            yield Finding(place, f"the name {name!r} is a region's too; choose another")


def _is_atom(name: str) -> bool:
    try:
        return name in atoms(parse(name))
    except FormulaError:
        return False


def _regions(workspace: Workspace, grid: Grid) -> Iterator[Finding]:
    for name, region in workspace.regions.items():
        place = ("workspace", "regions", name)
        if not grid.contains(*region.at_m):
            yield Finding(
                (*place, "at_m"), f"{_point(region.at_m)} lies outside the workspace {_area(grid)}"
            )
        elif region_location(grid, region) is None:
            yield Finding(
                place,
                f"no free cell's centre lies within {region.radius_m!r} m of"
                f" {_point(region.at_m)}; move it or make radius_m larger",
            )


def _closed_regions(workspace: Workspace) -> Iterator[Finding]:
    """Find changes that leave a region nowhere to be visited."""
    for index, grid in enumerate(later_grids(workspace)):
        for name, region in workspace.regions.items():
            if region_location(grid, region) is None:
                yield Finding(
                    ("workspace", "changes", index, "obstacles_m"),
                    f"from {workspace.changes[index].at_s!r} s on no free cell's centre lies within"
                    f" region {name!r}; leave it one",
                )


def _starts(scenario: Scenario, grid: Grid) -> Iterator[Finding]:
    for name, agent in scenario.agents.items():
        x_m, y_m, _ = agent.start
        place = ("agents", name, "start")
        if not grid.contains(x_m, y_m):
            what = f"lies outside the workspace {_area(grid)}"
        elif _covered(grid, x_m, y_m):
            what = "lies inside an obstacle; choose a free point"
        elif grid.location_at(x_m, y_m) is None:
            what = "lies in a cell that an obstacle covers in part; choose a point in a free cell"
        else:
            continue
        yield Finding(place, f"{_point((x_m, y_m))} {what}")


def _tasks(scenario: Scenario) -> Iterator[Finding]:
    for name, agent in scenario.agents.items():
        known = {*scenario.workspace.regions, *scenario.actions_of(name)}
        if not any((agent.task is not None, agent.tasks, agent.automaton is not None)):
            what = "missing; expected a formula, here or in tasks, or an automaton's file"
            yield Finding(("agents", name, "task"), what)
        if agent.automaton is not None:
            yield from _given_automaton(name, agent, known)
        formulas = [*_hard_tasks(agent)]
        if agent.soft is not None:
            formulas.append((("soft", "task"), agent.soft.task))
        for place, text in formulas:
            for what in _flaws(text, known):
                yield Finding(("agents", name, *place), what)


def _given_automaton(name: str, agent: Agent, known: Collection[str]) -> Iterator[Finding]:
    for place, _ in _hard_tasks(agent):
        what = "given beside an automaton; expected one or the other"
        yield Finding(("agents", name, *place), what)
    for what in _automaton_flaws(agent.automaton or "", known):
        yield Finding(("agents", name, "automaton"), what)


def _hard_tasks(agent: Agent) -> Iterator[tuple[Place, str]]:
    if agent.task is not None:
        yield ("task",), agent.task
    for index, text in enumerate(agent.tasks):
        yield ("tasks", index), text


def _flaws(text: str, known: Collection[str]) -> Iterator[str]:
    """Say what is wrong with a formula over some names."""
    try:
        unknown = sorted({*atoms(parse(text))}.difference(known))
    except FormulaError as error:
        yield explain(error)
        return
    for atom in unknown:
        yield _unknown(atom, known)


def _automaton_flaws(text: str, known: Collection[str]) -> Iterator[str]:
    """Say what is wrong with an automaton over some names."""
    try:
        automaton = read_automaton(text)
    except InputError as error:
        yield str(error)
        return
    lines = text.splitlines()
    for atom in sorted({*automaton.atoms}.difference(known)):
        line = next((n for n, line in enumerate(lines, start=1) if f'"{atom}"' in line), 1)
        yield f"automaton, line {line}: {_unknown(atom, known)}"


def _unknown(atom: str, known: Collection[str]) -> str:
    return f"unknown region or action {atom!r}; {did_you_mean(atom, known)}"


def _connectivity(scenario: Scenario, grid: Grid) -> Iterator[Finding]:
    names = list(scenario.agents)
    points_m = np.array([scenario.agents[name].start[:2] for name in names])
    offsets_m = points_m[:, None] - points_m[None]
    linked = np.hypot(offsets_m[..., 0], offsets_m[..., 1]) <= scenario.communication.range_m
    seeing = ""
    if scenario.radio.line_of_sight:
        linked &= sightlines(grid, points_m[:, None], points_m)
        seeing = " past all obstacles"
    _, labels = connected_components(linked, directed=False)
    for name, label in zip(names, labels.tolist(), strict=True):
        if label != labels[0]:
            yield Finding(
                ("agents", name, "start"),
                f"{_point(scenario.agents[name].start[:2])} isn't connected to {names[0]!r} by"
                f" links of at most range_m ({scenario.communication.range_m!r}){seeing};"
                " the team must start connected",
            )


def _reachability(scenario: Scenario, grid: Grid) -> Iterator[Finding]:
    regions = scenario.workspace.regions
    home = {name: region_location(grid, region) for name, region in regions.items()}
    for name, agent in scenario.agents.items():
        start = grid.location_at(*agent.start[:2])
        for place, named in _named(agent):
            for region in sorted(home.keys() & named):
                if grid.components[start] != grid.components[home[region]]:
                    yield Finding(
                        ("agents", name, *place),
                        f"region {region!r} can't be reached from the start"
                        f" {_point(agent.start[:2])}: obstacles close every way",
                    )


def _named(agent: Agent) -> Iterator[tuple[Place, frozenset[str]]]:
    """Yield the atoms of each hard task."""
    for place, text in _hard_tasks(agent):
        yield place, frozenset(atoms(parse(text)))
    if agent.automaton is not None:
        yield ("automaton",), frozenset(read_automaton(agent.automaton).atoms)


def _covered(grid: Grid, x_m: float, y_m: float) -> bool:
    x_min, y_min, x_max, y_max = grid.boxes.T
    inside = (x_min <= x_m) & (x_m <= x_max) & (y_min <= y_m) & (y_m <= y_max)
    return bool(inside.any()) and grid.location_at(x_m, y_m) is None


def _point(point_m: tuple[float, float]) -> str:
    return f"{point_m[0]!r}, {point_m[1]!r}"


def _area(grid: Grid) -> str:
    (x_m, y_m), (width_m, height_m) = grid.origin_m, grid.size_m
    return f"(x {x_m:g} to {x_m + width_m:g}, y {y_m:g} to {y_m + height_m:g})"
