"""Whether agreed strategies are equilibria: good runs, and runs with one thing wrong."""

from collections.abc import Callable
from copy import deepcopy
from dataclasses import replace
from functools import cache

import numpy as np
import pytest

from support.changing_hall import changing_hall
from support.command import CORRIDOR
from tlcomm_core.game.potential import evaluate
from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.game.solver import DEFAULT
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.method import Method
from tlcomm_core.mission import Mission
from tlcomm_core.pace import LOCK_STEP, Pace
from tlcomm_core.records import OfferRecord, RunRecords
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import Simulated, simulate
from tlcomm_tools.audit.equilibria.finding import EquilibriumFinding, audit_equilibria
from tlcomm_tools.audit.evidence import Evidence
from tlcomm_tools.audit.findings import Audit, audit_run
from tlcomm_tools.rounds import pose_round

ROUNDS = 3
ROUND = 2
SCENARIO = load_scenario(CORRIDOR)
FIRST = min(SCENARIO.agents)


@cache
def good_run(method: Method = Method.TEAM) -> Simulated:
    """Simulate a few rounds; nobody may change what is returned."""
    site = Site.from_scenario(SCENARIO)
    return simulate(Mission(site, 0, ROUNDS, None, method.solver(DEFAULT), method))


@cache
def problem() -> RoundProblem:
    """Return the round that strategies are spoilt of, as agents pose it."""
    return pose_round(Site.from_scenario(SCENARIO), ROUND, 0)


def records() -> RunRecords:
    """Return fresh records of the good run."""
    return deepcopy(good_run().records)


def judged(own: RunRecords, pace: Pace | None = LOCK_STEP) -> EquilibriumFinding:
    """Return what is found of some records."""
    evidence = Evidence.gather(SCENARIO, own, good_run().sim_ns * 1e-9)
    found = audit_equilibria(Method.TEAM, evidence, pace)
    assert found is not None
    return found


def held(own: RunRecords) -> TeamStrategy:
    """Return what the team holds for the round."""
    return next(it.strategy for it in own.strategies if it.strategy.round == ROUND)


def hold(own: RunRecords, other: TeamStrategy) -> None:
    """Let everybody hold another strategy for the round."""
    for index, record in enumerate(own.strategies):
        if record.strategy.round == ROUND:
            own.strategies[index] = replace(record, strategy=other)


def switched(strategy: Strategy) -> TeamStrategy:
    """Return the round's team strategy with another of one agent, and t_c and Φ as follow."""
    before = held(good_run().records)
    strategies = [strategy if it.agent == strategy.agent else it for it in before.strategies]
    opens_s = ROUND * SCENARIO.communication.period_s
    return evaluate(ROUND, strategies, opens_s, before.iteration, 1000.0, before.bound_s)


def worse() -> TeamStrategy:
    """Return the round's team strategy with one that is worse by a second at least, and allowed."""
    posed, before = problem(), held(good_run().records)
    index = posed.agents.index(FIRST)
    places = posed.places_of(before.strategies)
    is_open = posed.open_places([*places[:index], *places[index + 1 :]])
    arrival_s = posed.candidates[index].arrival_s
    for row, place in np.argwhere(np.isfinite(arrival_s) & is_open).tolist():
        other = switched(posed.strategy(index, place, row))
        if other.potential_s > before.potential_s + 1.0 and place != places[index]:
            return other
    raise AssertionError("no candidate is worse")


def test_agreed_strategies_are_equilibria() -> None:
    """Of all agents' in all rounds; also of those that agree on times alone, or by pairs."""
    assert judged(records()) == EquilibriumFinding(ROUNDS + 1, ROUNDS + 1, (), ())
    for method in (Method.STATIC, Method.PAIRWISE, Method.ORACLE):
        left = good_run(method)
        evidence = Evidence.gather(SCENARIO, left.records, left.sim_ns * 1e-9)
        found = audit_equilibria(method, evidence, LOCK_STEP)
        assert found is not None
        assert (found.judged, found.lacking, found.violations) == (found.strategies, (), ())
        assert found.judged > ROUNDS


@pytest.mark.parametrize("method", [Method.ALL_TIME, Method.NONE])
def test_where_nothing_is_chosen_nothing_is_judged(method: Method) -> None:
    """Turns leave each agent a single strategy."""
    evidence = Evidence.gather(SCENARIO, records(), 1.0)
    assert audit_equilibria(method, evidence, LOCK_STEP) is None


def test_a_worse_strategy_that_all_hold_is_named() -> None:
    """By the agent that should have another, with what that saves; no other check sees it."""
    own, other = records(), worse()
    hold(own, other)
    audit: Audit = audit_run(SCENARIO, Method.TEAM, own, good_run().sim_ns)
    saved_s = other.potential_s - held(good_run().records).potential_s
    best = held(good_run().records).part_of(FIRST)
    assert [name for name, lines in audit.checks.items() if lines] == ["equilibria"]
    assert (
        f"round {ROUND}: {FIRST} alone could lower Φ by {saved_s:.6f} s: at "
        f"({best.x_m:.3f}, {best.y_m:.3f}) m after step {best.task_index}"
    ) in audit.violations
    assert all(line.startswith(f"round {ROUND}: ") for line in audit.violations)


@pytest.mark.parametrize(
    ("field", "symbol"), [("extra_travel_s", "δ"), ("arrival_s", "t")], ids=["delta", "arrival"]
)
def test_times_that_are_not_the_candidates_are_named(field: str, symbol: str) -> None:
    """However slightly, with both figures."""
    own = records()
    true = held(own).part_of(FIRST)
    said_s = getattr(true, field) - 0.01
    hold(own, switched(replace(true, **{field: said_s})))
    assert (
        f"round {ROUND}: {FIRST}'s {symbol} is {said_s:.6f} s, "
        f"not {getattr(true, field):.6f} s as by its plan"
    ) in judged(own).violations


@pytest.mark.parametrize(
    ("change", "line"),
    [
        ({"task_index": 99}, " goes after step 99, which it didn't offer"),
        ({"x_m": 1.3}, " meets in the middle of no free cell"),
        ({"x_m": -9.0}, " meets in the middle of no free cell"),
    ],
    ids=["step", "beside", "outside"],
)
def test_what_is_no_candidate_is_named(change: dict[str, float], line: str) -> None:
    """A step that wasn't offered, and a place that isn't one."""
    own = records()
    hold(own, switched(replace(held(own).part_of(FIRST), **change)))
    assert f"round {ROUND}: {FIRST}{line}" in judged(own).violations


def spoil(own: RunRecords, change: Callable[[OfferRecord], OfferRecord | None]) -> None:
    """Change what the first agent offered for the round, or drop it."""
    changed = [change(it) if (it.agent, it.round) == (FIRST, ROUND) else it for it in own.offers]
    own.offers = [it for it in changed if it is not None]


@pytest.mark.parametrize(
    ("change", "line"),
    [
        ({"linear_mps": 2.0}, "offers to go at 2 m/s, not at {0:g} m/s"),
        ({"angular_radps": 0.0}, "offers to go at 0 rad/s, not at {1:g} rad/s"),
        ({"stops": ()}, "offers 0 steps, not 2 to 256"),
        ({"avoided": ("nowhere",)}, "avoids 'nowhere', which is no region"),
    ],
    ids=["speed", "turn", "steps", "region"],
)
def test_offers_that_cannot_be_are_named(change: dict[str, object], line: str) -> None:
    """Nothing is reckoned with them."""
    own = records()
    spoil(own, lambda it: replace(it, offer=replace(it.offer, **change)))
    drive = SCENARIO.drive_of(FIRST)
    said = line.format(drive.linear_mps, drive.angular_radps)
    assert judged(own).violations == (f"round {ROUND}: {FIRST} {said}",)


def test_a_plan_that_was_another_is_noticed() -> None:
    """Steps that end later than agreed upon give other times."""
    own = records()

    def later(it: OfferRecord) -> OfferRecord:
        stops = (
            replace(stop, finish_offset_s=stop.finish_offset_s + 1.0) for stop in it.offer.stops
        )
        return replace(it, offer=replace(it.offer, stops=tuple(stops)))

    spoil(own, later)
    assert any(f"{FIRST}'s t is" in line for line in judged(own).violations)


def test_a_missing_plan_is_no_pass() -> None:
    """One round isn't judged, and says why; one agent's plans missing altogether are a flaw."""
    own = records()
    spoil(own, lambda _: None)
    found = judged(own)
    assert (found.judged, found.strategies, found.violations) == (ROUNDS, ROUNDS + 1, ())
    assert found.lacking == (f"round {ROUND}: what {FIRST} planned isn't recorded",)
    own.offers = [it for it in own.offers if it.agent != FIRST]
    assert judged(own).violations == (f"{FIRST}: no plan offers recorded",)


def test_without_plans_or_pace_it_is_not_available() -> None:
    """As in bags of others: nothing is judged, and the reason is given once."""
    assert judged(records(), None).lacking == ("at which pace the run went isn't recorded",)
    own = records()
    own.offers.clear()
    found = judged(own)
    assert found.document() == {"strategies": ROUNDS + 1, "judged": 0}
    assert found.unavailable == ("what agents planned isn't recorded",)
    assert found.violations == ()


def test_what_cannot_be_told_is_not_judged() -> None:
    """A map that the scenario doesn't have, and a search that may have been broken off."""
    own = records()
    own.offers = [replace(it, offer=replace(it.offer, map_ns=5)) for it in own.offers]
    assert judged(own).lacking[0] == "round 1: the scenario has no map from 0.000 s on"
    own = records()
    hold(own, replace(held(own), iteration=999))
    assert judged(own).lacking == (
        f"round {ROUND}: after 999 moves the search may not have ended by itself",
    )


def test_at_another_pace_times_are_others() -> None:
    """Who runs freely reckons with late controllers."""
    assert any("'s t is" in line for line in judged(records(), Pace(1.0)).violations)


@pytest.mark.parametrize("seed", range(2))
def test_rounds_on_changing_maps_are_equilibria(seed: int) -> None:
    """Each on the map that it was planned on."""
    scenario = changing_hall(seed)
    left = simulate(Mission(Site.from_scenario(scenario), seed, None, 240.0))
    evidence = Evidence.gather(scenario, left.records, left.sim_ns * 1e-9)
    found = audit_equilibria(Method.TEAM, evidence, LOCK_STEP)
    assert found is not None
    assert (found.lacking, found.violations) == ((), ())
    assert found.judged > 2
    assert {it.offer.map_ns for it in left.records.offers} > {0}
