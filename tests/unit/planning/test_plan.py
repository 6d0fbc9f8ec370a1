"""The local plan as one endless sequence."""

from dataclasses import replace

from tlcomm_core.planning.plan import LocalPlan, PlanStep


def step(name: str) -> PlanStep:
    """Return a visit."""
    return PlanStep(name, 0, None, 1.0, frozenset({name}), satisfies=True)


def plan(prefix: tuple[PlanStep, ...], suffix: tuple[PlanStep, ...]) -> LocalPlan:
    """Return a plan whose figures don't matter."""
    return LocalPlan(prefix, suffix, 1.0, 2.0, 3.0, 0.0, 0.0, frozenset({"z"}))


def test_the_index_runs_on_through_every_pass_of_the_suffix() -> None:
    """After the prefix the suffix repeats for ever."""
    a, b, c = (step(name) for name in "abc")
    endless = plan((a,), (b, c))
    assert [endless.step(index).region for index in range(6)] == ["a", "b", "c", "b", "c", "b"]


def test_the_prefix_may_be_empty() -> None:
    """Without a prefix step 0 is the suffix's first."""
    only = step("a")
    assert plan((), (only,)).step(7) is only


def test_the_word_begins_with_what_is_true_at_the_start() -> None:
    """Then every step adds its label."""
    stem, loop = plan((step("a"),), (step("b"), step("c"))).word
    assert stem == ({"z"}, {"a"})
    assert loop == ({"b"}, {"c"})


def test_violations_are_counted_and_priced_once_for_the_prefix_and_per_pass() -> None:
    """The start counts with the prefix; a plan without a soft task violates nothing."""
    off = replace(step("a"), wanted=("b", "!a"))
    priced = replace(plan((off,), (step("b"), off)), initial_wanted=("c",), weight_s=2.5)
    assert (priced.prefix_violation, priced.suffix_violation) == (3, 2)
    assert (priced.prefix_price_s, priced.suffix_price_s) == (7.5, 5.0)
    strict = plan((), (step("a"),))
    assert (strict.prefix_violation, strict.suffix_price_s) == (0, 0.0)
