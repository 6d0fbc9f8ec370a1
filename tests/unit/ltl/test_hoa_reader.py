"""Automata that others wrote."""

from dataclasses import replace
from itertools import product

import pytest

from tlcomm_core.errors import InputError
from tlcomm_core.ltl import BuchiAutomaton, Construction, parse, read_hoa, to_hoa, translate

SPOT = """HOA: v1
name: "GFa & GFb" /* a comment /* inside */ another */
States: 1
Start: 0
AP: 2 "a" "b"
acc-name: generalized-Buchi 2
Acceptance: 2 Inf(0)&Inf(1)
properties: trans-labels explicit-labels trans-acc complete deterministic
--BODY--
State: 0
[!0&!1] 0
[0&!1] 0 {0}
[!0&1] 0 {1}
[0&1] 0 {0 1}
--END--
"""
STATE_BASED = """HOA: v1
Start: 0 AP: 1 "a"
Acceptance: 1 Inf(0)
Alias: @a 0  Alias: @not !@a
--BODY--
State: 0 "waits" [@a] 1 [@not] 0
State: 1 {0} [@a] 1 [!(@a | f) & t] 0
--END--"""
IMPLICIT = """HOA: v1 States: 2 Start: 1 AP: 2 "x" "y" Acceptance: 1 (Inf(0))
--BODY--
State: 0 {0} 0 0 0 0
State: 1 1 0 1 1
--END--"""
STATE_LABELS = """HOA: v1 Start: 0 Start: 1 AP: 1 "a" Acceptance: 0 t
--BODY--
State: [0] 0 1
State: [!0] 1 0
--END--"""


def language(automaton: BuchiAutomaton) -> list[bool]:
    """Return which short endless words over the atoms are accepted, in a fixed order."""
    letters = [
        frozenset(name for name, true in zip(automaton.atoms, values, strict=True) if true)
        for values in product([False, True], repeat=len(automaton.atoms))
    ]
    words = [(s, c) for s in product(letters, repeat=1) for c in product(letters, repeat=2)]
    return [accepts(automaton, [*stem, *loop], len(stem)) for stem, loop in words]


def accepts(automaton: BuchiAutomaton, word: list[frozenset[str]], back: int) -> bool:
    """Return whether some run on the word accepts: reach an accepting edge that comes again."""

    def after(node: tuple[int, int]) -> list[tuple[tuple[int, int], bool]]:
        state, place = node
        following = place + 1 if place + 1 < len(word) else back
        return [((t, following), acc) for t, acc in automaton.successors(state, word[place])]

    def reached(start: tuple[int, int]) -> set[tuple[int, int]]:
        seen, pending = {start}, [start]
        for node in pending:
            fresh = {target for target, _ in after(node)} - seen
            seen |= fresh
            pending += fresh
        return seen

    return any(
        accepting and node in reached(target)
        for node in reached((automaton.initial, 0))
        for target, accepting in after(node)
    )


@pytest.mark.parametrize(
    ("text", "formula"),
    [
        (SPOT, "G F a & G F b"),
        (STATE_BASED, "G F a"),
        (IMPLICIT, "F (x & !y)"),
        (STATE_LABELS, "G (a <-> X !a)"),
    ],
)
def test_the_language_is_the_one_described(text: str, formula: str) -> None:
    """Acceptance on edges or states, labels on edges, on states or implicit."""
    automaton = read_hoa(text)
    assert automaton.kind is Construction.GIVEN
    expected = translate(parse(formula))
    assert set(automaton.atoms) == set(expected.atoms)
    assert language(automaton) == language(replace(expected, atoms=automaton.atoms))


@pytest.mark.parametrize(
    "text",
    ["G F (a & F b)", "G (a -> F b) & G F c", "a U (b W c)", "F G a | G F !b", "true", "false"],
)
def test_what_we_write_we_read(text: str) -> None:
    """The very same automaton comes back."""
    automaton = translate(parse(text))
    found = read_hoa(to_hoa(automaton, parse(text)))
    assert replace(found, kind=automaton.kind) == automaton


def test_no_initial_state_accepts_nothing() -> None:
    """As the format has it."""
    assert read_hoa(
        "HOA: v1 AP: 0 Acceptance: 1 Inf(0) --BODY-- State: 0 [t] 0 {0} --END--"
    ).is_empty()


@pytest.mark.parametrize(
    ("old", "new", "message"),
    [
        ("HOA: v1", "HOA: v2", "line 1: expected version 'v1', found 'v2'"),
        ("--BODY--", "--ABORT--", "line 9: expected a header or '--BODY--', found '--ABORT--'"),
        ("HOA: v1\n", "", "line 1: expected 'HOA:', found 'name:'"),
        ("States: 1", "States: 1\nStates: 1", "line 4: expected each header once"),
        ("Start: 0", "Start: 0 & 0", "line 4: expected no universal branching, found '&'"),
        ("Start: 0", "Start: 3", "initial state 3"),
        ("Start: 0", "Start: x", "line 4: expected a state, found 'x'"),
        ("Start: 0", "Start: 0\nCare: 1", "line 5: expected no header of unknown meaning"),
        ('AP: 2 "a" "b"', 'AP: 2 "a"', "line 6: expected an atom in quotes, found 'acc-name:'"),
        ('AP: 2 "a" "b"', 'AP: 2 "a" "a"', "expected atoms that differ"),
        ("Inf(0)&Inf(1)", "Fin(0)", "line 7: expected Büchi or generalized Büchi"),
        ("Inf(0)&Inf(1)", "Inf(0)|Inf(1)", "line 7: expected Büchi or generalized Büchi"),
        ("Inf(0)&Inf(1)", "Inf(2)", "line 7: expected an acceptance set below 2, found '2'"),
        ("Acceptance: 2 Inf(0)&Inf(1)\n", "", "expected an 'Acceptance:' header"),
        ("[!0&!1] 0", "[!0&!2] 0", "line 11: expected the number of an atom below 2, found '2'"),
        ("[!0&!1] 0", "[!0&!1 0", "line 11: expected ']', found '0'"),
        ("[!0&!1] 0", "[(!0&!1] 0", "line 11: expected '\\)', found ']'"),
        ("[!0&!1] 0", "[!0&!1)] 0", "line 11: expected ']', found '\\)'"),
        ("[!0&!1] 0", "[!0&] 0", "line 11: expected 't', 'f', the number"),
        ("[!0&!1] 0", "[@x] 0", "line 11: .*known alias, found '@x'"),
        ("[!0&!1] 0", "[t] 1", "line 11: expected a state below 1, found '1'"),
        ("[!0&!1] 0", "[t] 0&0", "line 11: expected no universal branching"),
        ("[!0&!1] 0", "0", "expected labels on all edges of a state or on none"),
        ("[0&!1] 0 {0}", "[0&!1] 0 {2}", "line 12: expected an acceptance set below 2"),
        ("--END--", "State: 0 --END--", "line 15: expected each state once"),
        ("--END--", "", "line 16: expected a state, an edge or '--END--', found the end"),
        ("--END--", "--END-- HOA: v1", "line 15: expected one automaton, found 'HOA:'"),
        ("another */", "", "line 2: expected a comment that ends"),
        ("Start: 0", "Start: ?", "line 4: expected no such character, found '\\?'"),
        ("States: 1", "States: 100001", "line 3: expected a number of states below 100001"),
        ("States: 1", "States: 99999999999999999999", "line 3: expected a number of states"),
    ],
)  # fmt: skip
def test_a_flaw_is_named_with_its_line(old: str, new: str, message: str) -> None:
    """One line says where, what was expected and what was found."""
    assert old in SPOT
    with pytest.raises(InputError, match=message):
        read_hoa(SPOT.replace(old, new, 1))


def test_implicit_edges_must_cover_the_letters() -> None:
    """With two atoms there are four."""
    with pytest.raises(InputError, match="expected 2\\^2 edges without labels, not 3"):
        read_hoa(IMPLICIT.replace("1 1 0 1 1", "1 1 0 1"))


def test_a_state_without_description_is_refused() -> None:
    """An edge may not lead there."""
    with pytest.raises(InputError, match="expected a state that the body describes, found '1'"):
        read_hoa("HOA: v1 Start: 0 AP: 0 Acceptance: 0 t --BODY-- State: 0 [t] 1 --END--")


def test_deep_and_wide_labels_are_read_or_refused() -> None:
    """Neither parentheses without end nor exponentially many cubes hang the reader."""
    names = " ".join(f'"a{index}"' for index in range(60))
    frame = f"HOA: v1 Start: 0 AP: 60 {names} Acceptance: 0 t --BODY-- State: 0 [%s] 0 --END--"
    deep = read_hoa(frame % ("(!" * 20_000 + "0" + ")" * 20_000))
    assert deep.successors(0, frozenset({"a0"})) == ((0, True),)
    wide = " & ".join(f"({index} | {index + 1})" for index in range(0, 60, 2))
    with pytest.raises(InputError, match="at most 1000 cubes"):
        read_hoa(frame % wide)


def test_a_text_that_is_too_long_is_refused() -> None:
    """The limit is stated."""
    with pytest.raises(InputError, match="2000014 characters, at most 2000000 are read"):
        read_hoa("HOA: v1".ljust(2_000_014))
