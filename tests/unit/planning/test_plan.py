"""The local plan as one endless sequence."""

from tlcomm_core.planning.plan import LocalPlan, PlanStep


def test_the_index_runs_on_through_every_pass_of_the_suffix() -> None:
    """After the prefix the suffix repeats for ever."""
    a, b, c = (PlanStep(name, 0, None, 0.0, satisfies=False) for name in "abc")
    plan = LocalPlan((a,), (b, c), 1.0, 2.0)
    assert [plan.step(index).region for index in range(6)] == ["a", "b", "c", "b", "c", "b"]


def test_the_prefix_may_be_empty() -> None:
    """Without a prefix step 0 is the suffix's first."""
    only = PlanStep("a", 0, None, 1.0, satisfies=True)
    assert LocalPlan((), (only,), 0.0, 1.0).step(7) is only
