"""Formulas of any shape: printing and reading, normal form, translation, export."""

import pickle

from hypothesis import given, settings
from hypothesis import strategies as st

from tlcomm_core.errors import FormulaError
from tlcomm_core.ltl import (
    FALSE,
    TRUE,
    Formula,
    Operator,
    atom,
    explain,
    good_prefix_automaton,
    is_co_safe,
    negation_normal_form,
    parse,
    restarted,
    subformulas,
    to_text,
    translate,
)

CO_SAFE = [
    Operator.NEXT,
    Operator.EVENTUALLY,
    Operator.AND,
    Operator.OR,
    Operator.UNTIL,
    Operator.STRONG_RELEASE,
]
NAMES = st.sampled_from(["a", "b", "c", "Gate", "FGa", "_1"])


def formulas(operators: list[Operator], leaves: int) -> st.SearchStrategy[Formula]:
    """Return formulas over some operators with up to that many leaves."""

    def extend(children: st.SearchStrategy[Formula]) -> st.SearchStrategy[Formula]:
        return st.one_of(
            st.builds(Formula, st.just(operator), st.tuples(*[children] * operator.arity))
            for operator in operators
        )

    return st.recursive(
        st.builds(atom, NAMES) | st.sampled_from([TRUE, FALSE]), extend, max_leaves=leaves
    )


ANY = formulas([operator for operator in Operator if operator.arity], 12)
SOME_CO_SAFE = formulas(CO_SAFE, 6)


@given(ANY)
def test_printed_formulas_read_back(formula: Formula) -> None:
    """Reading what was printed gives the very same object."""
    assert parse(to_text(formula)) is formula
    assert pickle.loads(pickle.dumps(formula)) is formula  # noqa: S301  our own bytes


@given(ANY)
def test_no_parenthesis_is_needless(formula: Formula) -> None:
    """Removing any pair of parentheses changes the meaning or breaks the text."""
    text = to_text(formula)
    opened: list[int] = []
    for position, character in enumerate(text):
        if character == "(":
            opened.append(position)
        elif character == ")":
            start = opened.pop()
            shorter = f"{text[:start]} {text[start + 1 : position]} {text[position + 1 :]}"
            try:
                assert parse(shorter) is not formula
            except FormulaError:
                continue


@given(st.text(alphabet="abFGXUR01()!&|<->[]~ \n\x00é", max_size=40) | st.text())
def test_any_text_is_read_or_refused(text: str) -> None:
    """A text either is a formula or gives one line with a place inside it."""
    refusal: FormulaError | None = None
    try:
        formula = parse(text)
    except FormulaError as error:
        refusal = error
    if refusal is None:
        assert parse(to_text(formula)) is formula
    else:
        assert 0 <= refusal.position <= len(text)
        assert len(explain(refusal).splitlines()) == 1


@given(ANY)
def test_normal_form_is_final_and_has_negations_at_atoms(formula: Formula) -> None:
    """Normalizing twice changes nothing; -> and <-> are gone; ! stands before atoms."""
    normal = negation_normal_form(formula)
    assert negation_normal_form(normal) is normal
    for node in subformulas(normal):
        assert node.operator not in {Operator.IMPLIES, Operator.IFF}
        if node.operator is Operator.NOT:
            assert node.children[0].operator is Operator.ATOM


@settings(deadline=None)
@given(SOME_CO_SAFE)
def test_restarted_automata_are_deterministic_and_complete(formula: Formula) -> None:
    """Every letter has exactly one edge in every state, and every state can finish φ."""
    assert is_co_safe(formula)
    automaton = restarted(formula)
    assert automaton.is_deterministic()
    assert automaton.is_complete()
    unsatisfiable = translate(formula).is_empty()
    assert automaton.is_empty() == unsatisfiable


@settings(deadline=None)
@given(SOME_CO_SAFE)
def test_good_prefix_states_differ(formula: Formula) -> None:
    """No two states of the minimal automaton have the same good continuations."""
    automaton = good_prefix_automaton(formula)
    count = len(automaton.transitions)
    letters = [
        frozenset(name for bit, name in enumerate(automaton.atoms) if code >> bit & 1)
        for code in range(1 << len(automaton.atoms))
    ]
    table = [[automaton.step(state, letter) for letter in letters] for state in range(count)]
    different = {
        (one, other)
        for one in range(count)
        for other in range(count)
        if (one == automaton.satisfied) != (other == automaton.satisfied)
    }
    while True:
        more = {
            (one, other)
            for one in range(count)
            for other in range(count)
            if any(pair in different for pair in zip(table[one], table[other], strict=True))
        }
        if more <= different:
            break
        different |= more
    assert len(different) == count * (count - 1)


@settings(deadline=None)
@given(ANY)
def test_translation_is_reproducible(formula: Formula) -> None:
    """Translating twice gives equal automata, and every state of a satisfiable one is useful."""
    automaton = translate(formula)
    assert translate(formula) == automaton
    if automaton.is_empty():
        assert automaton.state_count == 1
