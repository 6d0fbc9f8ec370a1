"""Actions that need a region or others first, in a scenario's file."""

import pytest

from support.good_scenario import GOOD
from tlcomm_core.errors import ScenarioError
from tlcomm_core.scenario.conditions import MAX_PAIRS
from tlcomm_core.scenario.loader import dumps, loads

CONDITIONAL = GOOD.replace(
    "actions: {pick: 4.0}\n",
    """\
actions:
  pick: 4.0
  weigh: {duration_s: 1.0, after: [pick]}
  drop: {duration_s: 2, at: [a, b], after: [pick, weigh]}
""",
)


def test_an_action_may_need_a_region_or_others_first() -> None:
    """A number is a duration; an agent's own actions replace the team's whole."""
    scenario = loads(CONDITIONAL)
    assert scenario.actions_of("one") == {"pick": 4.0, "weigh": 1.0, "drop": 2.0}
    assert scenario.actions_of("two") == {"pick": 1.0, "weigh": 1.0, "drop": 2.0}
    conditional = scenario.conditional_actions_of("one")
    assert list(conditional) == ["weigh", "drop"]
    assert conditional["drop"].at == ("a", "b")
    assert conditional["drop"].after == ("pick", "weigh")
    assert list(scenario.conditional_actions_of("two")) == ["weigh"]
    assert loads(dumps(scenario)) == scenario


@pytest.mark.parametrize(
    ("old", "new", "line", "message"),
    [
        ("at: [a, b]", "at: [a, c]", 16, "actions.drop.at[1]: unknown region 'c'; expected one of"),
        ("[pick, weigh]", "[pick, weihg]", 16,
         "actions.drop.after[1]: unknown action 'weihg'; did you mean 'weigh'?"),
        ("after: [pick]", "after: [drop]", 15,
         "actions.weigh.after: 'weigh' after 'drop' after 'weigh': none of them can ever be"),
        ("after: [pick]", "after: [weigh]", 15, "actions.weigh.after: 'weigh' after 'weigh': none"),
        ("drop: 2}", "drop: {duration_s: 1, after: [pikc]}}", 25,
         "agents.two.actions.drop.after[0]: unknown action 'pikc'; did you mean 'pick'?"),
        ("{pick: 1.0, drop: 2}", "{pick: {duration_s: 1, after: [weigh]}}", 25,
         "agents.two.actions.pick.after: 'pick' after 'weigh' after 'pick'"),
        ("duration_s: 2,", "duration_s: -2,", 16, "actions.drop.duration_s: found -2"),
        ("duration_s: 2,", "", 16, "actions.drop.duration_s: missing"),
        ("after: [pick]", "afer: [pick]", 15,
         "actions.weigh.afer: unknown field; did you mean 'after'?"),
        ("at: [a, b]", "at: []", 16, "actions.drop.at: found []; expected at least 1 items"),
        ("pick: 4.0\n", "pick: soon\n", 14, "actions.pick: found 'soon'; expected a valid number"),
        ("weigh: {duration_s: 1.0,", "weigh: {duration_s: 1.0, at: a,", 15,
         "actions.weigh.at: found 'a'"),
    ],
)  # fmt: skip
def test_conditions_that_make_no_sense_are_refused(
    old: str, new: str, line: int, message: str
) -> None:
    """Unknown names, circles and wrong fields, each in its place."""
    assert CONDITIONAL.count(old) == 1
    with pytest.raises(ScenarioError) as failure:
        loads(CONDITIONAL.replace(old, new))
    assert str(failure.value).startswith(f"scenario:{line}: {message}")


def test_an_agent_can_only_remember_so_much() -> None:
    """Each pair of an action and one before it doubles the states of its plan."""
    names = [f"a{number}" for number in range(MAX_PAIRS + 1)]
    text = CONDITIONAL.replace(
        "  pick: 4.0\n", "".join(f"  {name}: 1.0\n" for name in [*names, "pick"])
    )
    few = text.replace("after: [pick]", f"after: [{', '.join(names[:6])}]")
    assert len(loads(few).conditional_actions_of("one")["weigh"].after) == 6
    many = text.replace("after: [pick]", f"after: [{', '.join(names[:7])}]")
    with pytest.raises(ScenarioError, match=r"actions: 9 pairs of an action .* at most 8"):
        loads(many)
