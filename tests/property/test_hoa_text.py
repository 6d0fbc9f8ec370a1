"""Any text is read as an automaton or refused, and automata survive the way through text."""

from dataclasses import replace

from hypothesis import given, settings
from hypothesis import strategies as st

from tlcomm_core.errors import InputError
from tlcomm_core.ltl import Formula, Operator, atom, parse, read_hoa, to_hoa, translate

GOOD = to_hoa(translate(parse("G (a -> F b) & F c")), parse("a"))
WORDS = st.sampled_from(
    [*GOOD.split(), "@x", "Alias: @x 0", "Inf", "t", "f", "(", ")", "[", "]", "{", "}", "!", "&"]
)
SMALL = st.recursive(
    st.builds(atom, st.sampled_from("abc")),
    lambda inner: st.one_of(
        st.builds(Formula, st.just(operator), st.tuples(*[inner] * operator.arity))
        for operator in Operator
        if operator.arity
    ),
    max_leaves=5,
)


def refusal(text: str) -> str | None:
    """Return why a text is refused, None if it is read."""
    try:
        read_hoa(text)
    except InputError as error:
        return str(error)
    return None


@settings(deadline=None)
@given(st.integers(0, len(GOOD.split())), st.integers(0, 5), st.lists(WORDS, max_size=4))
def test_a_spoilt_text_is_read_or_refused(place: int, cut: int, new: list[str]) -> None:
    """Words left out or put in lead to an automaton or to an error of one line."""
    words = GOOD.split()
    message = refusal(" ".join([*words[:place], *new, *words[place + cut :]]))
    assert message is None or message.startswith("automaton, line 1: expected ")


@given(st.text(alphabet='HOA: v1"[]{}()!&|@t0/*-\n\x00é') | st.text())
def test_any_text_is_refused_politely(text: str) -> None:
    """Nothing but an error of one line comes of it."""
    for whole in (text, f"HOA: v1 Acceptance: 0 t {text} --BODY-- --END--"):
        assert "\n" not in (refusal(whole) or "")


@settings(deadline=None)
@given(SMALL)
def test_what_is_written_is_read(formula: Formula) -> None:
    """The very same automaton comes back."""
    automaton = translate(formula)
    found = read_hoa(to_hoa(automaton, formula))
    assert replace(found, kind=automaton.kind) == automaton
