"""Plans do what their formulas say, take the time that they say, and exist where they can."""

from functools import cache

import numpy as np
import pytest
from hypothesis import HealthCheck, event, given, settings
from hypothesis import strategies as st

from support.lasso_semantics import holds
from support.small_plant import START, SmallPlant
from tlcomm_core.errors import PlanningError
from tlcomm_core.geometry import Pose
from tlcomm_core.ltl import FALSE, TRUE, Formula, Operator, atom, parse
from tlcomm_core.planning.plan import LocalPlan
from tlcomm_core.planning.synthesis import plan_task
from tlcomm_core.planning.transition_system import TransitionSystem

PLANT = SmallPlant()
TINY = SmallPlant(("p", "r"))

Word = tuple[frozenset[str], ...]

BINARY = [operator for operator in Operator if operator.arity == 2]
UNARY = [operator for operator in Operator if operator.arity == 1]


def formulas(names: str, leaves: int) -> st.SearchStrategy[Formula]:
    """Formulas of the whole grammar over some atoms."""
    base = st.sampled_from([*map(atom, names.split()), TRUE, FALSE])

    def extend(inner: st.SearchStrategy[Formula]) -> st.SearchStrategy[Formula]:
        unary = st.builds(lambda o, a: Formula(o, (a,)), st.sampled_from(UNARY), inner)
        binary = st.builds(
            lambda o, a, b: Formula(o, (a, b)), st.sampled_from(BINARY), inner, inner
        )
        return unary | binary

    return st.recursive(base, extend, max_leaves=leaves)


def starts() -> st.SearchStrategy[Pose]:
    """Poses in free cells, at centres and beside them."""
    metres = st.sampled_from([0.25, 0.3, 0.75, 1.1, 2.75, 3.25])
    yaws = st.sampled_from([0.0, 0.785398163397448, 2.0, -3.0])
    grid = PLANT.times.grid
    return st.builds(Pose, metres, metres, yaws).filter(
        lambda pose: grid.location_at(pose.x_m, pose.y_m) is not None
    )


def assert_does_what_it_says(plan: LocalPlan, formula: Formula, start: Pose) -> None:
    """Check the word, and the times by driving leg by leg, twice through the suffix."""
    stem, loop = PLANT.word(plan, start)
    assert holds(formula, stem, loop)
    assert plan.word == (tuple(stem), tuple(loop))
    assert any(step.satisfies for step in plan.suffix)
    prefix_s, entry = PLANT.execute(plan.prefix, start)
    assert plan.prefix_s == pytest.approx(prefix_s, abs=1e-9)
    suffix_s, end = PLANT.execute(plan.suffix, entry)
    assert plan.suffix_s == pytest.approx(suffix_s, abs=1e-9)
    assert suffix_s > 0.0
    assert plan.prefix_m == pytest.approx(PLANT.driven_m(plan.prefix, start), abs=1e-9)
    assert plan.suffix_m == pytest.approx(PLANT.driven_m(plan.suffix, entry), abs=1e-9)
    until = next(place for place, step in enumerate(plan.suffix) if step.satisfies) + 1
    first_s, _ = PLANT.execute((*plan.prefix, *plan.suffix[:until]), start)
    assert plan.first_s == pytest.approx(first_s, abs=1e-9)
    again_s, end_again = PLANT.execute(plan.suffix, end)
    assert again_s == suffix_s
    assert end_again == end
    if plan.prefix:
        assert end == entry


@settings(max_examples=250, deadline=None, suppress_health_check=[HealthCheck.too_slow])
@given(formula=formulas("p hall r m vault collect unload", 6), start=starts())
def test_a_plan_satisfies_its_formula_in_the_time_announced(formula: Formula, start: Pose) -> None:
    """The word, by LTL's definition, and the legs, driven one by one, are as planned."""
    try:
        plan = plan_task(formula, PLANT.system(start))
    except PlanningError:
        event("no plan")
        return
    event(f"{len(plan.prefix)} + {len(plan.suffix)} steps")
    assert_does_what_it_says(plan, formula, start)


@pytest.mark.parametrize(
    "text",
    [
        "G F (p & collect & F (r & unload & F (m & collect)))",
        "G F (p & X (r & X m))",
        "G F p & G F r & G (p -> X !r)",
        "(!m U (p & collect)) & G F m & G (m -> X (unload U r))",
        "F (p & F r) & F G (m & !collect)",
        "G (collect -> X (!collect U unload)) & G F collect",
        "(!p) & X X (p & hall) & G F (hall & !p)",
        "G F (p | r) & G !(hall & !p) & (F m R !r)",
        "G F (collect & unload) | G F (p & !hall) | (!r W m) & F G r",
        "G (p <-> X r) & G F (p | m)",
        "m M (!r) & G F r",
    ],
)
def test_tasks_of_every_shape_are_planned_right(text: str) -> None:
    """Formulas with X, U, W, M, R, negations and conjunctions."""
    formula = parse(text)
    assert_does_what_it_says(plan_task(formula, PLANT.system()), formula, START)


@cache
def short_runs() -> tuple[TransitionSystem, frozenset[tuple[Word, Word]]]:
    """Return a tiny system, and stems and loops of its runs that close within four steps."""
    system = TINY.system(actions={"collect": 4.0})
    words: set[tuple[Word, Word]] = set()

    def extend(states: list[int], word: Word) -> None:
        for step in np.flatnonzero(system.source == states[-1]).tolist():
            longer = (*word, system.labels[system.label[step]])
            target = int(system.target[step])
            for entry in (place for place, state in enumerate(states) if state == target):
                words.add((longer[: entry + 1], longer[entry + 1 :]))
            if len(states) < 4:
                extend([*states, target], longer)

    extend([0], (system.labels[system.initial_label],))
    return system, frozenset(words)


@settings(max_examples=150, deadline=None)
@given(formula=formulas("p r collect", 5))
def test_where_no_plan_is_found_no_short_run_would_do(formula: Formula) -> None:
    """If planning gives up, no run that closes within four steps satisfies the formula."""
    system, words = short_runs()
    try:
        plan_task(formula, system)
    except PlanningError:
        event("no plan")
        assert not any(holds(formula, stem, loop) for stem, loop in words)


def test_the_short_runs_do_reach_things() -> None:
    """Among them is one that collects at p and returns from r."""
    formula = parse("G F (p & collect) & G F r")
    _, words = short_runs()
    assert any(holds(formula, stem, loop) for stem, loop in words)
