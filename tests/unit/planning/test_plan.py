"""The local plan as one endless sequence."""

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
