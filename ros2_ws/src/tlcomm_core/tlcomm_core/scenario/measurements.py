"""What the field that agents measure must be like.

``check_field``  all that is wrong with it
``stations_of``  where it can be measured, and the phases of their drifts
"""

import math
from collections.abc import Iterator
from itertools import pairwise

from tlcomm_core.scenario.finding import Finding, did_you_mean
from tlcomm_core.scenario.model import MeasuredField, Scenario

__all__ = ["check_field", "stations_of"]


def stations_of(scenario: Scenario) -> dict[str, float]:
    """Return the regions in which the field can be measured, with their phases (rad).

    If the scenario doesn't say, they are all those in which some agent can perform the action, in
    the scenario's order, their phases spread evenly over 2π.
    """
    field = scenario.field
    if field is None:
        return {}
    if field.drift.phases_rad is not None:
        return dict(field.drift.phases_rad)
    possible: set[str] = set()
    for agent in scenario.agents:
        if field.action in scenario.actions_of(agent):
            action = scenario.conditional_actions_of(agent).get(field.action)
            at = None if action is None else action.at
            possible.update(scenario.workspace.regions if at is None else at)
    stations = [name for name in scenario.workspace.regions if name in possible]
    return {name: math.tau * index / len(stations) for index, name in enumerate(stations)}


def check_field(scenario: Scenario) -> Iterator[Finding]:
    """Yield what is wrong with the field of a scenario, if it has one."""
    field = scenario.field
    if field is None:
        return
    known = {name for agent in scenario.agents for name in scenario.actions_of(agent)}
    if field.action not in known:
        what = f"unknown action {field.action!r}; {did_you_mean(field.action, known)}"
        yield Finding(("field", "action"), what)
    regions = scenario.workspace.regions
    for name in field.drift.phases_rad or ():
        if name not in regions:
            what = f"unknown region {name!r}; {did_you_mean(name, regions)}"
            yield Finding(("field", "drift", "phases_rad", name), what)
    yield from _profile(field)
    yield from _exchange(field, scenario)


def _profile(field: MeasuredField) -> Iterator[Finding]:
    times_s = [time_s for time_s, _ in field.profile]
    for index, (time_s, following_s) in enumerate(pairwise(times_s), start=1):
        if following_s <= time_s:
            yield Finding(
                ("field", "profile", index),
                f"{following_s!r} s isn't later than the breakpoint before ({time_s!r} s);"
                " expected ascending times",
            )


def _exchange(field: MeasuredField, scenario: Scenario) -> Iterator[Finding]:
    exchange, communication = field.exchange, scenario.communication
    place = ("field", "exchange")
    if not communication.hop_latency_s < exchange.period_s < communication.duration_s:
        yield Finding(
            (*place, "period_s"),
            f"{exchange.period_s!r} isn't between hop_latency_s ({communication.hop_latency_s!r})"
            f" and duration_s ({communication.duration_s!r}) of communication",
        )
    most = len(scenario.agents) - 1
    if exchange.step is not None and exchange.step * most >= 1.0:
        yield Finding(
            (*place, "step"),
            f"{exchange.step!r} isn't below 1/{most}: an agent may have {most} neighbours, and the"
            " consensus converges for ε < 1/Δ; leave it out, and it is chosen by the neighbours",
        )
