"""Tests of ``tlcomm_core.ltl.run_monitor``."""

import numpy as np
import pytest

from tlcomm_core.ltl import Monitor, RunMonitor, Verdict, parse, read_hoa, tableau_automaton

LETTERS = [frozenset[str](), frozenset("a"), frozenset("b"), frozenset("ab")]


def monitor_of(text: str) -> RunMonitor:
    """Return a monitor of a formula's automaton."""
    return RunMonitor(tableau_automaton(parse(text)))


@pytest.mark.parametrize(
    ("text", "word", "verdict", "final_after", "passes"),
    [
        ("G !b", ["a", "a"], Verdict.PRESUMABLY_TRUE, None, (0, 1)),
        ("G !b", ["a", "b", "a"], Verdict.FALSE, 2, (0,)),
        ("G F a", ["a", "b"], Verdict.PRESUMABLY_FALSE, None, (0,)),
        ("G F a", ["a", "b", "a"], Verdict.PRESUMABLY_TRUE, None, (0, 2)),
        ("F a", ["b", "a"], Verdict.TRUE, 2, None),
        ("a & !a", [], Verdict.FALSE, 0, ()),
        ("true", [], Verdict.TRUE, 0, ()),
        ("F G a", ["a", "a"], None, None, None),
    ],
)
def test_verdicts(
    text: str,
    word: list[str],
    verdict: Verdict | None,
    final_after: int | None,
    passes: tuple[int, ...] | None,
) -> None:
    """Each verdict, the letter that settled it, and the passes."""
    monitor = monitor_of(text)
    for letter in word:
        monitor.read(letter)
    assert (monitor.verdict, monitor.final_after, monitor.passes) == (verdict, final_after, passes)


def both_monitors(text: str, seed: int) -> tuple[RunMonitor, Monitor]:
    """Return the automaton's monitor and the formula's after the same six random letters."""
    runs, exact = monitor_of(text), Monitor(parse(text))
    for number in np.random.default_rng(seed).integers(len(LETTERS), size=6):
        letter = LETTERS[number]
        runs.read(letter)
        exact.read(letter)
    return runs, exact


@pytest.mark.parametrize(
    "text", ["a U b", "G (a -> X b)", "a R b", "G a | X b", "X X a", "G F (a & F b) & G (a | b)"]
)
def test_what_is_settled_is_told_in_time(text: str) -> None:
    """Deterministic automata settle with the formula's monitor, which has the complement too."""
    for seed in range(12):
        runs, exact = both_monitors(text, seed)
        assert runs.final_after == exact.final_after
        assert (runs.verdict is Verdict.TRUE) == (exact.verdict is Verdict.TRUE)


@pytest.mark.parametrize("text", ["F G a & G (b | a)", "F G a & X b", "(a U b) | G F a"])
def test_violation_is_exact_for_any_automaton(text: str) -> None:
    """False is told with the formula's monitor, whatever the number of runs."""
    for seed in range(12):
        runs, exact = both_monitors(text, seed)
        assert (runs.verdict is Verdict.FALSE) == (exact.verdict is Verdict.FALSE)


def test_a_run_that_may_stop_is_not_assured() -> None:
    """A state without an edge for some letter can still be violated."""
    text = 'HOA: v1 Start: 0 AP: 1 "a" Acceptance: 1 Inf(0) --BODY-- State: 0 [0] 0 {0} --END--'
    monitor = RunMonitor(read_hoa(text))
    monitor.read("a")
    assert monitor.verdict is Verdict.PRESUMABLY_TRUE
    monitor.read("")
    assert (monitor.verdict, monitor.final_after) == (Verdict.FALSE, 2)


def test_runs_that_can_only_fail_are_left_out() -> None:
    """They keep no word open, and don't count as further runs."""
    text = """HOA: v1 Start: 0 AP: 1 "a" Acceptance: 1 Inf(0) --BODY--
        State: 0 [t] 1 [0] 2 {0} State: 1 [t] 1 State: 2 [0] 2 {0} --END--"""
    monitor = RunMonitor(read_hoa(text))
    monitor.read("a")
    assert (monitor.verdict, monitor.passes) == (Verdict.PRESUMABLY_TRUE, (0,))
    monitor.read("")
    assert monitor.verdict is Verdict.FALSE
