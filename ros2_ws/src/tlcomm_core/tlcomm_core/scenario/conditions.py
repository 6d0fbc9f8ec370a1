"""What the conditions of actions must mean.

``MAX_PAIRS``         how much an agent can be asked to remember
``check_conditions``  all that is wrong with them
"""

from collections.abc import Iterator, Mapping
from graphlib import CycleError, TopologicalSorter
from typing import Final

from tlcomm_core.scenario.document import Place
from tlcomm_core.scenario.finding import Finding, did_you_mean
from tlcomm_core.scenario.model import Action, Scenario

__all__ = ["MAX_PAIRS", "check_conditions"]

MAX_PAIRS: Final = 8
"""The most pairs of an action and another that it comes after: each doubles the states."""


def check_conditions(scenario: Scenario) -> Iterator[Finding]:
    """Yield what is wrong with the conditions of the team's actions and of each agent's own."""
    regions = scenario.workspace.regions
    team = scenario.actions
    sections: list[tuple[Place, Mapping[str, float | Action]]] = [(("actions",), team)]
    sections += [
        (("agents", name, "actions"), own.actions) for name, own in scenario.agents.items()
    ]
    for place, given in sections:
        if given:
            known = {**team, **given}
            yield from _unknown(place, given, known, regions)
            yield from _impossible(place, given, known)


def _unknown(
    place: Place,
    given: Mapping[str, float | Action],
    known: Mapping[str, float | Action],
    regions: Mapping[str, object],
) -> Iterator[Finding]:
    for name, action in given.items():
        if not isinstance(action, Action):
            continue
        for index, region in enumerate(action.at or ()):
            if region not in regions:
                what = f"unknown region {region!r}; {did_you_mean(region, regions)}"
                yield Finding((*place, name, "at", index), what)
        for index, other in enumerate(action.after):
            if other not in known:
                what = f"unknown action {other!r}; {did_you_mean(other, known)}"
                yield Finding((*place, name, "after", index), what)


def _impossible(
    place: Place, given: Mapping[str, float | Action], known: Mapping[str, float | Action]
) -> Iterator[Finding]:
    """Say which actions wait for each other, and whether there is too much to remember."""
    after = {
        name: set(action.after) for name, action in known.items() if isinstance(action, Action)
    }
    pairs = sum(map(len, after.values()))
    if pairs > MAX_PAIRS:
        what = f"{pairs} pairs of an action and one that it comes after; expected at most"
        yield Finding(place, f"{what} {MAX_PAIRS} for one agent")
    try:
        TopologicalSorter(after).prepare()
    except CycleError as error:
        circle: list[str] = error.args[1]
        named = next((name for name in given if name in circle), None)
        where = place if named is None else (*place, named, "after")
        what = f"{' after '.join(map(repr, circle[::-1]))}: none of them can ever be the first"
        yield Finding(where, what)
