"""Why a plan is optimal, in the small plant."""

import re
from fractions import Fraction

import pytest

from support.small_plant import SmallPlant
from tlcomm_core.errors import IntractableTaskError, UnreachableTaskError
from tlcomm_core.ltl import parse
from tlcomm_core.planning import on_the_fly
from tlcomm_core.planning.explanation import Move, explain_plan
from tlcomm_core.planning.lasso import Objective
from tlcomm_core.planning.relaxation import soft_task
from tlcomm_core.planning.synthesis import plan_task

# Without the hall, which lies on the way, so that passing it costs nothing.
SYSTEM = SmallPlant(("p", "r", "m", "vault")).system()
TASK = parse("G F (p & collect & F (r & unload))")


def test_the_plan_is_the_one_that_planning_finds() -> None:
    """By either objective."""
    for objective in (Objective(), Objective(Fraction(2))):
        assert explain_plan(TASK, SYSTEM, objective).plan == plan_task(TASK, SYSTEM, objective)


def test_what_the_task_asks_for_has_no_rival() -> None:
    """Without an action that it names there is no plan; without a way there is a dearer one."""
    found = explain_plan(TASK, SYSTEM)
    rivals = {rival.without: rival.plan for rival in found.rivals}
    assert rivals[Move("p", "p", "collect")] is None
    assert rivals[Move("r", "r", "unload")] is None
    detour = rivals[Move("p", "r", None)]
    assert detour is not None
    assert detour.suffix_s > found.plan.suffix_s


def test_the_second_best_is_the_best_rival() -> None:
    """None takes less time, and it takes more than the optimum here."""
    found = explain_plan(TASK, SYSTEM)
    assert found.second_best is not None
    assert found.second_best.plan is not None
    others = [rival.plan.suffix_s for rival in found.rivals if rival.plan]
    assert found.second_best.plan.suffix_s == min(others) > found.plan.suffix_s


def test_a_move_may_stay_in_the_prefix() -> None:
    """Only suffixes do without it: a task that is to collect at once still has its rivals."""
    found = explain_plan(parse("F (p & collect) & G F (p | m)"), SYSTEM)
    (rival,) = found.rivals
    assert rival.plan is not None
    assert any(step.action == "collect" for step in rival.plan.prefix)


def test_the_only_suffix_has_no_second_best() -> None:
    """Collecting at p for good is one move."""
    found = explain_plan(parse("F G (p & collect)"), SYSTEM)
    assert [(rival.without, rival.plan) for rival in found.rivals] == [
        (Move("p", "p", "collect"), None)
    ]
    assert found.second_best is None


def test_a_task_without_a_plan_has_nothing_to_explain() -> None:
    """Why there is none is told as by planning."""
    task = parse("G F vault")
    with pytest.raises(UnreachableTaskError, match="'vault' can't be reached") as told:
        explain_plan(task, SYSTEM)
    with pytest.raises(UnreachableTaskError, match=re.escape(str(told.value))):
        plan_task(task, SYSTEM)


def test_a_product_too_large_is_not_explained(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nor is it built to see."""
    monkeypatch.setattr(on_the_fly, "MOST_STATES", 3)
    with pytest.raises(IntractableTaskError, match="is larger than 3; split the task"):
        explain_plan(TASK, SYSTEM)


def test_rivals_weigh_the_soft_task_too() -> None:
    """With a soft task time and price count together, for each rival as for the plan."""
    soft = soft_task(parse("G F (m & collect)"), 1.0)
    found = explain_plan(TASK, SYSTEM, soft=soft)
    assert found.plan == plan_task(TASK, SYSTEM, soft=soft)
    plans = [found.plan, *(rival.plan for rival in found.rivals if rival.plan)]
    costs_s = [plan.suffix_s + plan.suffix_price_s for plan in plans]
    assert all(plan.weight_s == 1.0 for plan in plans)
    assert any(plan.suffix_price_s > 0.0 for plan in plans)
    assert found.second_best is not None
    assert found.second_best.plan is not None
    second_best = found.second_best.plan
    assert second_best.suffix_s + second_best.suffix_price_s == pytest.approx(min(costs_s[1:]))
    assert costs_s[0] <= min(costs_s[1:])
