"""The HOA export, read back by a small strict reader written from the format's definition."""

import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import product

import pytest

from tlcomm_core.ltl import BuchiAutomaton, parse, to_hoa, translate

TOKEN = re.compile(
    r'\s+|(?P<string>"(?:\\.|[^"\\])*")|(?P<header>[A-Za-z_][A-Za-z0-9_-]*:)'
    r"|(?P<marker>--(?:BODY|END)--)|(?P<word>[A-Za-z_][A-Za-z0-9_-]*)"
    r"|(?P<number>0|[1-9][0-9]*)|(?P<sign>[\[\](){}!&|])",
    re.DOTALL,
)
MANDATORY = {"HOA:", "Acceptance:"}


@dataclass
class Reading:
    """What an HOA text says."""

    headers: dict[str, list[str]] = field(default_factory=dict)
    edges: dict[int, list[tuple[list[str], int, bool]]] = field(default_factory=dict)


def tokens(text: str) -> Iterator[tuple[str, str]]:
    """Yield (kind, text) of each token; anything else is an error."""
    position = 0
    while position < len(text):
        match = TOKEN.match(text, position)
        assert match is not None, text[position:]
        position = match.end()
        if match.lastgroup is not None:
            yield match.lastgroup, match.group()


def read(text: str) -> Reading:
    """Read an HOA text with transition labels and transition acceptance."""
    stream = list(tokens(text))
    body = stream.index(("marker", "--BODY--"))
    assert stream[-1] == ("marker", "--END--")
    assert stream[:2] == [("header", "HOA:"), ("word", "v1")]
    reading = Reading()
    for kind, token in stream[:body]:
        if kind == "header":
            assert token not in reading.headers
            current = reading.headers.setdefault(token, [])
        else:
            current.append(token)
    assert reading.headers.keys() >= MANDATORY
    read_body(stream[body + 1 : -1], reading)
    return reading


def read_body(stream: list[tuple[str, str]], reading: Reading) -> None:
    """Read "State: n" and "[label] target {0}" lines."""
    place = 0
    state = -1
    while place < len(stream):
        if stream[place] == ("header", "State:"):
            state = int(stream[place + 1][1])
            assert state not in reading.edges
            reading.edges[state] = []
            place += 2
            continue
        assert stream[place] == ("sign", "[")
        closing = stream.index(("sign", "]"), place)
        label = [token for _, token in stream[place + 1 : closing]]
        kind, target = stream[closing + 1]
        assert kind == "number"
        place = closing + 2
        marks = [token for _, token in stream[place : place + 3]] == ["{", "0", "}"]
        place += 3 * marks
        reading.edges[state].append((label, int(target), marks))


def label_holds(label: list[str], values: tuple[bool, ...]) -> bool:
    """Evaluate a label expression; ! binds tighter than &, & tighter than |."""
    words = {"!": " not ", "&": " and ", "|": " or ", "t": "True", "f": "False"}
    parts = [words.get(token) or f"values[{int(token)}]" for token in label]
    return bool(eval("".join(parts), {"values": values}))  # noqa: S307  digits and operators only


def unquoted(text: str) -> str:
    """Return the content of a quoted string."""
    assert text.startswith('"')
    assert text.endswith('"')
    return re.sub(r"\\(.)", r"\1", text[1:-1], flags=re.DOTALL)


def allowed(reading: Reading, state: int, values: tuple[bool, ...]) -> list[tuple[int, bool]]:
    """Return the edges that a letter allows."""
    return [(t, marks) for label, t, marks in reading.edges[state] if label_holds(label, values)]


def letters(automaton: BuchiAutomaton) -> Iterator[tuple[tuple[bool, ...], frozenset[str]]]:
    """Yield every letter as truth values and as a set of names."""
    for values in product([False, True], repeat=len(automaton.atoms)):
        names = zip(automaton.atoms, values, strict=True)
        yield values, frozenset(name for name, value in names if value)


FORMULAS = [
    "G F ((p & c) & F ((r & u) & F m))",
    "G (a -> F b)",
    "a U (b W c) & G F a",
    "F G a",
    "X a <-> b",
    "true",
    "false",
    "a R (b M !c)",
]


@pytest.mark.parametrize("text", FORMULAS)
def test_export_says_what_the_automaton_does(text: str) -> None:
    """Read back, every letter allows the same edges with the same acceptance in every state."""
    automaton = translate(parse(text))
    reading = read(to_hoa(automaton, parse(text)))
    assert reading.headers["States:"] == [str(automaton.state_count)]
    assert reading.headers["Start:"] == [str(automaton.initial)]
    count, *names = reading.headers["AP:"]
    assert int(count) == len(names)
    assert tuple(map(unquoted, names)) == automaton.atoms
    assert reading.headers["acc-name:"] == ["Buchi"]
    assert list(reading.edges) == list(range(automaton.state_count))
    for state in reading.edges:
        for values, label in letters(automaton):
            edges: dict[int, bool] = {}
            for target, marked in allowed(reading, state, values):
                edges[target] = edges.get(target, False) or marked
            assert tuple(edges.items()) == automaton.successors(state, label)


@pytest.mark.parametrize("text", FORMULAS)
def test_stated_properties_are_true(text: str) -> None:
    """Determinism and completeness are stated exactly when every letter bears them out."""
    automaton = translate(parse(text))
    reading = read(to_hoa(automaton, parse(text)))
    counts = [
        len(allowed(reading, state, values))
        for state in reading.edges
        for values, _ in letters(automaton)
    ]
    stated = set(reading.headers["properties:"])
    assert ("deterministic" in stated) == (max(counts, default=0) <= 1)
    assert ("complete" in stated) == (min(counts, default=0) >= 1)
    assert {"trans-labels", "explicit-labels", "trans-acc"} <= stated


def test_strings_are_escaped() -> None:
    """Quotes and backslashes in a name survive the round trip."""
    formula = parse("F a")
    name = 'a "quoted" \\ name'
    reading = read(to_hoa(translate(formula), formula, name))
    assert [unquoted(word) for word in reading.headers["name:"]] == [name]


def test_the_name_is_the_formula_unless_given() -> None:
    """Without a name the formula's text is written."""
    formula = parse("G F (a && b)")
    reading = read(to_hoa(translate(formula), formula))
    assert reading.headers["name:"] == ['"G F (a & b)"']
