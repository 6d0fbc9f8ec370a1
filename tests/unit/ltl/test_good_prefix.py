"""Good prefixes and the restarted automaton: known sizes, boundary cases, depth."""

import pytest

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.ltl import (
    Construction,
    good_prefix_automaton,
    parse,
    restarted,
)

TASK = "(p1 & collect) & F ((r1 & unload) & F (m1 & measure))"


@pytest.mark.parametrize(
    ("text", "states"),
    [
        ("true", 1),
        ("false", 1),
        ("a", 3),
        ("F a", 2),
        ("X a", 4),
        ("a U b", 3),
        ("F a & F b", 4),
        ("X (a | !a)", 1),
        ("X (a & !a)", 1),
        ("X (X a | X !a)", 1),
        ("F (a & F (b & F c))", 4),
        ("(F a | F b) & F c", 4),
    ],
)
def test_minimal_sizes(text: str, states: int) -> None:
    """The automaton has one state per class of equivalent prefixes."""
    assert len(good_prefix_automaton(parse(text)).transitions) == states


def test_settled_formulas_need_no_letter() -> None:
    """The empty prefix of a valid formula is good, of an unsatisfiable one no prefix is."""
    assert good_prefix_automaton(parse("X (a | !a)")).is_good(())
    impossible = good_prefix_automaton(parse("F (a & !a & X b)"))
    assert impossible.satisfied is None
    assert not impossible.is_good([frozenset({"a", "b"})] * 3)


def test_the_task_of_the_plant_has_three_states() -> None:
    """Collect, unload, measure: three states, each letter one edge, accepting back to the start."""
    automaton = restarted(parse(TASK))
    assert automaton.state_count == 3
    assert automaton.is_deterministic()
    assert automaton.is_complete()
    assert automaton.kind is Construction.RESTARTED_GOOD_PREFIX
    collect, unload, measure = (
        frozenset({"p1", "collect"}),
        frozenset({"r1", "unload"}),
        frozenset({"m1", "measure"}),
    )
    ((loaded, _),) = automaton.successors(automaton.initial, collect)
    ((emptied, _),) = automaton.successors(loaded, unload)
    assert len({automaton.initial, loaded, emptied}) == 3
    assert automaton.successors(emptied, measure) == ((automaton.initial, True),)
    accepting = [edge for row in automaton.transitions for edge in row if edge.accepting]
    assert {edge.target for edge in accepting} == {automaton.initial}


def test_other_letters_leave_the_task_where_it_is() -> None:
    """Passing a region without acting, or acting out of turn, changes nothing."""
    automaton = restarted(parse(TASK))
    for letter in ({"p1"}, {"collect", "r1"}, {"r1", "unload"}, {"m1", "measure"}, set()):
        assert automaton.successors(automaton.initial, frozenset(letter)) == (
            (automaton.initial, False),
        )


def test_a_task_that_is_always_true_accepts_every_letter() -> None:
    """Where the empty prefix is good, every transition is accepting."""
    for text in ("true", "a | !a", "X (a | !a)", "a | X !a"):
        automaton = restarted(parse(text))
        assert automaton.state_count == 1
        assert automaton.successors(0, frozenset({"a"})) == ((0, True),)
        assert automaton.successors(0, frozenset()) == ((0, True),)


def test_an_impossible_task_accepts_nothing() -> None:
    """Where no prefix is good, the automaton is empty but still complete."""
    for text in ("false", "a & !a", "X (a & !a)", "(a & X a) & X !a"):
        automaton = restarted(parse(text))
        assert automaton.is_empty()
        assert automaton.is_complete()
        assert automaton.is_deterministic()


def test_other_formulas_are_refused() -> None:
    """A formula that isn't co-safe has no such automaton: our own bug."""
    with pytest.raises(LocalMisuseError, match="co-safe"):
        restarted(parse("G a"))


def test_many_atoms_in_one_letter_cost_no_enumeration() -> None:
    """Guards over 60 atoms are built without trying 2^60 letters."""
    either = restarted(parse(" | ".join(f"a{index}" for index in range(60))))
    assert either.state_count == 1
    every = restarted(parse(" & ".join(f"a{index}" for index in range(60))))
    assert every.successors(0, frozenset(f"a{index}" for index in range(60))) == ((0, True),)
    assert every.successors(0, frozenset({"a3"})) == ((0, False),)


def test_deep_formulas_are_determinized() -> None:
    """A chain of 60 steps gives 60 states."""
    chain = "".join(f"a{index} & X F (" for index in range(59)) + "end" + ")" * 59
    assert restarted(parse(chain)).state_count == 60
