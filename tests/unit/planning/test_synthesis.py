"""Plans, and reasons why there is none, in the small plant."""

from fractions import Fraction

import pytest

from support.small_plant import SmallPlant
from tlcomm_core.errors import UnreachableTaskError, UnsatisfiableTaskError
from tlcomm_core.geometry import Pose
from tlcomm_core.ltl import parse, read_hoa, to_hoa, translate
from tlcomm_core.planning.lasso import Objective
from tlcomm_core.planning.plan import LocalPlan, PlanStep
from tlcomm_core.planning.synthesis import plan_task

PLANT = SmallPlant()
SYSTEM = PLANT.system()


def plan(text: str) -> LocalPlan:
    """Return the plan from the usual start."""
    return plan_task(parse(text), SYSTEM)


def deeds(steps: tuple[PlanStep, ...]) -> list[str]:
    """Return what is done where, without mere visits."""
    return [f"{step.region} {step.action}" for step in steps if step.action]


def rotations(cycle: list[str]) -> list[list[str]]:
    """Return the ways to tell a cycle."""
    return [cycle[start:] + cycle[:start] for start in range(len(cycle))]


@pytest.mark.parametrize(
    ("order", "text"),
    [
        (["p collect", "r unload", "m collect"],
         "G F (p & collect & F (r & unload & F (m & collect)))"),
        (["p collect", "m collect", "r unload"],
         "G F (p & collect & F (m & collect & F (r & unload)))"),
    ],
)  # fmt: skip
def test_the_order_of_nested_eventualities_is_kept(order: list[str], text: str) -> None:
    """□◇(a ∧ ◇(b ∧ ◇c)) is a, b, c again and again, and not a, c, b; satisfied once a pass."""
    suffix = plan(text).suffix
    assert deeds(suffix) in rotations(order)
    assert [f"{step.region} {step.action}" for step in suffix if step.satisfies] == order[-1:]


def test_the_makespan_is_that_of_the_round_trip() -> None:
    """The suffix costs its legs and actions."""
    found = plan("G F (p & collect & F (r & unload))")
    _, pose = PLANT.execute(found.prefix, SYSTEM.states[0].pose)
    suffix_s, _ = PLANT.execute(found.suffix, pose)
    assert found.suffix_s == pytest.approx(suffix_s, abs=1e-9)
    assert sum(step.duration_s for step in found.suffix) == 6.5


def test_acting_where_one_already_is_takes_no_way() -> None:
    """At p for good, collecting over and over costs its duration."""
    found = plan("F G (p & collect)")
    assert deeds(found.suffix) == ["p collect"]
    assert found.suffix_s == 4.0


def test_a_task_may_be_to_stay_away() -> None:
    """Outside all regions the plan is to idle there, with no prefix."""
    found = plan("G !(p | hall | r | m)")
    assert found.prefix == ()
    assert [(step.region, step.action) for step in found.suffix] == [("", None)]


def test_a_step_names_the_region_that_the_task_names() -> None:
    """Of two regions at one place the plan names the task's."""
    twins = PLANT.system()
    both = {location: ("other", *names) for location, names in twins.regions.items()}
    object.__setattr__(twins, "regions", both)
    assert [step.region for step in plan_task(parse("F G p"), twins).suffix] == ["p"]


@pytest.mark.parametrize("text", ["G F (p & !p)", "F p & G !p", "false", "X (r U false)"])
def test_a_contradiction_is_unsatisfiable(text: str) -> None:
    """No agent could do it, and the error says so."""
    with pytest.raises(UnsatisfiableTaskError, match="no word satisfies"):
        plan(text)


def test_what_is_out_of_reach_has_no_plan() -> None:
    """Others could do it."""
    with pytest.raises(UnreachableTaskError, match="'G F vault' can't be done"):
        plan("G F vault & G F p")


def test_an_automaton_is_used_as_it_is() -> None:
    """What a formula's automaton becomes in HOA and back plans as the formula does."""
    formula = parse("G F (p & collect & F (r & unload))")
    automaton = read_hoa(to_hoa(translate(formula), formula))
    assert plan_task(automaton, SYSTEM) == plan_task(formula, SYSTEM)


def test_an_automaton_without_a_plan_says_so() -> None:
    """It has no text to quote."""
    text = 'HOA: v1 Start: 0 AP: 1 "p" Acceptance: 1 Inf(0) --BODY-- State: 0 [0] 0 --END--'
    with pytest.raises(UnsatisfiableTaskError, match=r"^the automaton contradicts itself"):
        plan_task(read_hoa(text), SYSTEM)
    text = text.replace("[0] 0", "[0] 0 {0}")
    with pytest.raises(UnreachableTaskError, match=r"^the automaton can't be done: "):
        plan_task(read_hoa(text), SYSTEM)


def test_the_word_begins_with_the_start() -> None:
    """A start in the hall satisfies `hall` at once, though the plan leaves it at once."""
    start = Pose(0.75, 0.75, 0.0)
    found = plan_task(parse("hall & X r & G F r"), PLANT.system(start))
    assert found.step(0).region == "r"


def test_planning_twice_gives_the_same_plan() -> None:
    """Ties are settled by the input alone."""
    text = "G F p & G F r & G F m & G F hall"
    assert plan_task(parse(text), SmallPlant().system()) == plan(text)


def test_gamma_chooses_between_the_prefix_and_the_suffix() -> None:
    """A small γ never satisfies later than a large one, nor with a shorter suffix."""
    formula = parse("G F (p & collect & F (r & unload)) | G F m")
    small, large = (
        plan_task(formula, SYSTEM, Objective(gamma))
        for gamma in (Fraction(1, 1000), Fraction(1000))
    )
    least = plan_task(formula, SYSTEM)
    assert small.first_s <= large.first_s
    assert least.suffix_s <= large.suffix_s <= small.suffix_s


RESPONSES = " & ".join(f"G (a{i} -> F b{i})" for i in range(8))


def test_more_responses_than_an_automaton_holds_can_be_planned_for() -> None:
    """The letters of the plant are few, so that eight conjoined responses and a round fit."""
    found = plan(f"{RESPONSES} & G (p -> F m) & G F p")
    assert {step.region for step in found.suffix} == {"p", "m"}


def test_a_part_of_too_many_that_cant_be_done_is_told() -> None:
    """Where the whole automaton is too large, the plant's letters still tell the part."""
    with pytest.raises(UnreachableTaskError, match=r"^'G F \(p & m\)' can't be done: 'p & m'"):
        plan(f"{RESPONSES} & G F (p & m)")
