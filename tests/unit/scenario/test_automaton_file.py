"""Tests of automata in scenarios: files, texts, and what can be wrong with either."""

from pathlib import Path

import pytest

from tlcomm_core.errors import ScenarioError
from tlcomm_core.ltl import BuchiAutomaton, Formula
from tlcomm_core.scenario.loader import dumps, load_scenario, loads
from tlcomm_core.scenario.task import task_of

SCENARIO = """name: small
workspace:
  size_m: [4.0, 1.0]
  cell_m: 0.5
  regions: {a: {at_m: [0.25, 0.25], radius_m: 0.3}, b: {at_m: [3.25, 0.25], radius_m: 0.3}}
communication: {range_m: 1.0, period_s: 60.0, duration_s: 5.0}
motion: {linear_mps: 1.0, angular_radps: 1.5}
actions: {pick: 4.0}
agents:
  one:
    start: [0.25, 0.25, 0.0]
    automaton: both.hoa
  two: {start: [0.75, 0.25, 0.0], task: "G F b"}
"""
# As Spot writes G F (a & pick) & G F b, with two acceptance sets.
BOTH = """HOA: v1
name: "G(F(a & pick) & Fb)"
States: 1
Start: 0
AP: 3 "a" "pick" "b"
acc-name: generalized-Buchi 2
Acceptance: 2 Inf(0)&Inf(1)
properties: trans-labels explicit-labels trans-acc complete deterministic
--BODY--
State: 0
[!2 & (!0 | !1)] 0
[0&1&!2] 0 {0}
[2 & (!0 | !1)] 0 {1}
[0&1&2] 0 {0 1}
--END--
"""


@pytest.fixture
def path(tmp_path: Path) -> Path:
    """Write the scenario and its automaton."""
    (tmp_path / "both.hoa").write_text(BOTH)
    (tmp_path / "small.yaml").write_text(SCENARIO)
    return tmp_path / "small.yaml"


def test_a_file_becomes_the_task(path: Path) -> None:
    """Its path begins where the scenario is; other agents keep their formulas."""
    scenario = load_scenario(path)
    automaton = task_of(scenario.agents["one"])
    assert isinstance(automaton, BuchiAutomaton)
    assert (automaton.atoms, automaton.state_count) == (("a", "pick", "b"), 2)
    assert isinstance(task_of(scenario.agents["two"]), Formula)


def test_written_out_the_scenario_stands_alone(path: Path, tmp_path: Path) -> None:
    """The text is in it as a readable block, and loads back equal without the file."""
    scenario = load_scenario(path)
    text = dumps(scenario)
    assert "    automaton: |\n      HOA: v1\n" in text
    (tmp_path / "both.hoa").unlink()
    assert loads(text) == scenario
    path.write_text(text)
    assert load_scenario(path) == scenario


def test_line_ends_of_another_system_make_no_difference(path: Path, tmp_path: Path) -> None:
    """Nor do blanks at the ends of lines, and the text is still a block."""
    scenario = load_scenario(path)
    (tmp_path / "both.hoa").write_bytes(BOTH.replace("\n", "  \r\n").encode())
    assert load_scenario(path) == scenario


# What to replace in the automaton, by what, and what the error says after file, line and field.
BAD = [
    ("HOA: v1", "HOA: v2", "automaton, line 1: expected version 'v1', found 'v2'"),
    ("HOA: v1", "digraph {", "line 1: found 'digraph {'; expected 'HOA:' first"),
    ('"pick"', '"pikc"', "automaton, line 5: unknown region or action 'pikc'; did you mean 'pick'"),
    ("[0&1&2] 0", "[0&1&2] 7", "automaton, line 14: expected a state below 1, found '7'"),
    ("[0&1&2]", "[0&1&3]", "automaton, line 14: expected the number of an atom below 3"),
    ("--END--", "", "automaton, line 16: expected a state, an edge or '--END--', found the end"),
    ("Inf(0)&Inf(1)", "Fin(0)|Inf(1)", "automaton, line 7: expected Büchi or generalized Büchi"),
]


@pytest.mark.parametrize(("good", "bad", "expected"), BAD)
def test_a_bad_file_is_one_line_with_both_places(
    path: Path, tmp_path: Path, good: str, bad: str, expected: str
) -> None:
    """The scenario's line and field, the automaton's file and line, and what was expected."""
    (tmp_path / "both.hoa").write_text(BOTH.replace(good, bad))
    with pytest.raises(ScenarioError) as caught:
        load_scenario(path)
    message = str(caught.value)
    assert message.startswith(f"{path}:12: agents.one.automaton: in '{tmp_path / 'both.hoa'}': ")
    assert expected in message
    assert "\n" not in message


def test_a_bad_text_has_its_line_within(path: Path) -> None:
    """An automaton in the scenario itself names no other file."""
    block = "".join(f"      {line}\n" for line in BOTH.replace('"b"', '"c"').splitlines())
    text = SCENARIO.replace("both.hoa\n", f"|\n{block}")
    with pytest.raises(ScenarioError) as caught:
        loads(text)
    assert str(caught.value).startswith(
        "scenario:12: agents.one.automaton: automaton, line 5: unknown region or action 'c'"
    )
    path.write_text(text.replace('"c"', '"b"'))
    assert load_scenario(path).agents["one"].automaton == BOTH


def test_a_missing_file_is_named(path: Path, tmp_path: Path) -> None:
    """With the reason, and what else could be there."""
    (tmp_path / "both.hoa").unlink()
    with pytest.raises(ScenarioError, match=r"small.yaml:12: agents.one.automaton: .*both.hoa' "):
        load_scenario(path)


@pytest.mark.parametrize(
    ("replacement", "expected"),
    [
        ("task: 'G F a'\n    automaton: both.hoa", "one.task: given beside an automaton; expected"),
        (
            "motion: {}",
            "agents.one.task: missing; expected a formula, here or in tasks, or an automaton",
        ),
        ("tasks: ['G F a']\n    automaton: both.hoa", "one.tasks[0]: given beside an automaton"),
        ("automaton: 7", "agents.one.automaton: found 7; expected a valid string"),
    ],
)
def test_a_task_is_one_of_two(path: Path, replacement: str, expected: str) -> None:
    """Neither, both, and another type are refused."""
    path.write_text(SCENARIO.replace("automaton: both.hoa", replacement))
    with pytest.raises(ScenarioError) as caught:
        load_scenario(path)
    assert expected in str(caught.value)


def test_files_too_large_are_refused(path: Path, tmp_path: Path) -> None:
    """One file by its bytes; two by what they make of the scenario that a run writes."""
    comment = f"/* {'x' * 600_000} */\n"
    (tmp_path / "both.hoa").write_text(f"{BOTH}{comment}{comment}")
    with pytest.raises(ScenarioError, match="has more than 1000000 bytes"):
        load_scenario(path)
    (tmp_path / "both.hoa").write_text(f"{BOTH}{comment}")
    load_scenario(path)
    path.write_text(SCENARIO.replace('task: "G F b"', "automaton: both.hoa"))
    with pytest.raises(ScenarioError, match=r":13: agents.two.automaton: with its automata the"):
        load_scenario(path)
