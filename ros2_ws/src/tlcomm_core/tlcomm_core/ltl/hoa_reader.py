"""Automata that other tools wrote in the Hanoi Omega-Automata format, version 1.

- ``read_hoa``   a Büchi automaton from its text
"""

from dataclasses import dataclass, field
from typing import Final

from tlcomm_core.errors import InputError
from tlcomm_core.ltl.automaton import BuchiAutomaton, Construction, Transition
from tlcomm_core.ltl.formula import Formula
from tlcomm_core.ltl.guard import Cube, Guard, simplified
from tlcomm_core.ltl.hoa_text import Cursor, Token, label, letters_of

__all__ = ["MAX_ATOMS", "MAX_STATES", "read_hoa"]

MAX_STATES: Final = 100_000
MAX_ATOMS: Final = 1000
_MAX_MARKS: Final = 64

_ONCE: Final = frozenset({"HOA:", "States:", "AP:", "Acceptance:", "acc-name:", "tool:", "name:"})


@dataclass(frozen=True, slots=True)
class _Edge:
    """An edge with the marks that it carries or that its state does, as a bit set."""

    guard: Guard
    target: int
    marks: int


@dataclass(slots=True)
class _Header:
    """What comes before the body."""

    states: int | None = None
    starts: list[int] = field(default_factory=list)
    atoms: tuple[str, ...] = ()
    aliases: dict[str, Formula] = field(default_factory=dict)
    set_count: int = 0
    required: int = 0


def read_hoa(text: str) -> BuchiAutomaton:
    """Return the Büchi automaton that a text in HOA v1 describes.

    Acceptance is Büchi or generalized Büchi (a conjunction of ``Inf``), on states or transitions;
    labels are on transitions, on states or implicit. Several acceptance sets are made one with a
    counter, several initial states with a state before them. States keep their numbers if neither
    is the case.

    Raises:
        InputError: the text isn't HOA v1, or describes another kind of automaton: alternating, or
            with another acceptance; or it is larger than the limits.

    Source: Babiak et al., "The Hanoi Omega-Automata format", 2015; the counter as in Gastin and
        Oddoux, "Fast LTL to Büchi automata translation", 2001.
    Cost: linear in the text and in the guards' cubes; with k acceptance sets up to k times as many
        states.
    """
    cursor = Cursor(text)
    header = _HeaderReader(cursor).read()
    rows = _BodyReader(cursor, header).read()
    initial = _initial(header, rows)
    transitions, start = _with_one_mark(rows, initial, header.required)
    return BuchiAutomaton(header.atoms, start, transitions, Construction.GIVEN)


class _HeaderReader:
    """Reads up to and with ``--BODY--``."""

    def __init__(self, cursor: Cursor) -> None:
        self._cursor = cursor
        self._header = _Header()
        self._seen: set[str] = set()

    def read(self) -> _Header:
        """Return the header; ``InputError`` points at what isn't one."""
        cursor = self._cursor
        if cursor.next.text != "HOA:":
            raise cursor.next.error("expected 'HOA:'")
        while cursor.next.kind == "header":
            token = cursor.take()
            if token.text in _ONCE and token.text in self._seen:
                raise token.error("expected each header once")
            self._seen.add(token.text)
            self._item(token)
        body = cursor.take()
        if body.text != "--BODY--":
            raise body.error("expected a header or '--BODY--'")
        if "Acceptance:" not in self._seen:
            raise body.error("expected an 'Acceptance:' header before the body")
        return self._header

    def _item(self, token: Token) -> None:
        cursor, header = self._cursor, self._header
        match token.text:
            case "HOA:":
                version = cursor.expect("word", "'v1'")
                if version.text != "v1":
                    raise version.error("expected version 'v1'")
            case "States:":
                header.states = cursor.number("a number of states", below=MAX_STATES + 1)
            case "Start:":
                header.starts.append(cursor.number("a state", below=MAX_STATES))
                _refuse_alternation(cursor)
            case "AP:":
                header.atoms = self._atoms()
            case "Alias:":
                self._alias()
            case "Acceptance:":
                header.set_count = cursor.number("a number of acceptance sets", _MAX_MARKS + 1)
                header.required = _required(cursor, header.set_count)
            case _:
                self._other(token)

    def _atoms(self) -> tuple[str, ...]:
        cursor = self._cursor
        if self._header.aliases:
            raise cursor.next.error("expected 'AP:' before the aliases")
        count = cursor.number("a number of atoms", below=MAX_ATOMS + 1)
        names: list[str] = []
        for _ in range(count):
            token = cursor.next
            name = cursor.string("an atom in quotes")
            if not name or name in names:
                raise token.error("expected atoms that differ and aren't empty")
            names.append(name)
        return tuple(names)

    def _alias(self) -> None:
        token = self._cursor.expect("alias", "an alias")
        if token.text in self._header.aliases:
            raise token.error("expected each alias once")
        self._header.aliases[token.text] = label(
            self._cursor, self._header.atoms, self._header.aliases
        )

    def _other(self, token: Token) -> None:
        """Pass over what doesn't bear on the language: by the format, a small initial says so."""
        if not token.text[0].islower():
            raise token.error("expected no header of unknown meaning")
        while self._cursor.next.kind not in {"header", "marker", "end"}:
            self._cursor.take()


def _required(cursor: Cursor, set_count: int) -> int:
    """Read a conjunction of Inf and return its acceptance sets as a bit set."""
    if cursor.next.text == "t":
        cursor.take()
        return 0
    required = opened = 0
    while True:
        while cursor.skip("("):
            opened += 1
        if cursor.next.text != "Inf":
            raise cursor.next.error("expected Büchi or generalized Büchi acceptance, Inf(…)&Inf(…)")
        cursor.take()
        cursor.sign("(")
        required |= 1 << cursor.number("an acceptance set", below=set_count)
        cursor.sign(")")
        while opened and cursor.skip(")"):
            opened -= 1
        if not cursor.skip("&"):
            break
    if opened or cursor.next.kind not in {"header", "marker"}:
        raise cursor.next.error("expected Büchi or generalized Büchi acceptance, Inf(…)&Inf(…)")
    return required


class _BodyReader:
    """Reads from ``--BODY--`` to ``--END--``."""

    def __init__(self, cursor: Cursor, header: _Header) -> None:
        self._cursor = cursor
        self._header = header
        self._most = MAX_STATES if header.states is None else header.states
        self._rows: dict[int, list[_Edge]] = {}
        self._guards: dict[Formula, Guard] = {}
        self._named: list[tuple[int, Token]] = []

    def read(self) -> list[list[_Edge]]:
        """Return the edges of each state; ``InputError`` points at what isn't a body."""
        cursor = self._cursor
        while cursor.skip("State:"):
            self._state()
        end = cursor.take()
        if end.text != "--END--":
            raise end.error("expected a state, an edge or '--END--'")
        if cursor.next.kind != "end":
            raise cursor.next.error("expected one automaton")
        for state, token in self._named:
            if state not in self._rows:
                raise token.error("expected a state that the body describes")
        for state in self._header.starts:
            if state not in self._rows:
                raise end.error(f"expected a description of the initial state {state}")
        count = max(self._rows, default=-1) + 1 if self._header.states is None else self._most
        return [self._rows.get(state, []) for state in range(count)]

    def _state(self) -> None:
        cursor = self._cursor
        common = self._label()
        token = cursor.next
        state = cursor.number("a state", below=self._most)
        if state in self._rows:
            raise token.error("expected each state once")
        if cursor.next.kind == "string":
            cursor.take()
        marks = self._marks()
        rows: list[tuple[Guard | None, int, int]] = []
        while cursor.next.text == "[" or cursor.next.kind == "number":
            place = cursor.next
            own = self._label()
            if own is not None and common is not None:
                raise place.error("expected no label on an edge of a state with one")
            rows.append((own or common, self._target(), marks | self._marks()))
        unlabelled = sum(guard is None for guard, _, _ in rows)
        if unlabelled:
            self._check_implicit(unlabelled, len(rows), cursor.next)
        self._rows[state] = [
            _Edge(self._implicit(index) if guard is None else guard, target, carried)
            for index, (guard, target, carried) in enumerate(rows)
        ]

    def _check_implicit(self, unlabelled: int, count: int, token: Token) -> None:
        """Check that either no edge has a label or all have, and the former cover the letters."""
        if unlabelled < count:
            raise token.error("expected labels on all edges of a state or on none")
        atoms = len(self._header.atoms)
        if count.bit_length() != atoms + 1 or count != 1 << atoms:
            raise token.error(f"expected 2^{atoms} edges without labels, not {count}")

    def _implicit(self, letter: int) -> Guard:
        names = self._header.atoms
        true = frozenset(name for place, name in enumerate(names) if letter >> place & 1)
        return Guard((Cube(true, frozenset(names) - true),))

    def _label(self) -> Guard | None:
        cursor = self._cursor
        token = cursor.next
        if not cursor.skip("["):
            return None
        formula = label(cursor, self._header.atoms, self._header.aliases)
        cursor.sign("]")
        if formula not in self._guards:
            self._guards[formula] = letters_of(formula, token)
        return self._guards[formula]

    def _target(self) -> int:
        token = self._cursor.next
        target = self._cursor.number("a state", below=self._most)
        _refuse_alternation(self._cursor)
        self._named.append((target, token))
        return target

    def _marks(self) -> int:
        marks = 0
        if self._cursor.skip("{"):
            while not self._cursor.skip("}"):
                marks |= 1 << self._cursor.number("an acceptance set", self._header.set_count)
        return marks


def _refuse_alternation(cursor: Cursor) -> None:
    if cursor.next.text == "&":
        raise cursor.next.error("expected no universal branching")


def _initial(header: _Header, rows: list[list[_Edge]]) -> int:
    """Return the initial state, adding one if there are none or several."""
    starts = list(dict.fromkeys(header.starts))
    if len(starts) == 1:
        return starts[0]
    rows.append([edge for start in starts for edge in rows[start]])
    return len(rows) - 1


def _with_one_mark(
    rows: list[list[_Edge]], initial: int, required: int
) -> tuple[tuple[tuple[Transition, ...], ...], int]:
    """Return the rows with acceptance on edges, and the initial state."""
    sets = [place for place in range(required.bit_length()) if required >> place & 1]
    if len(sets) <= 1:
        return tuple(
            _joined([(e, e.target, e.marks & required == required) for e in row]) for row in rows
        ), initial
    number = {(initial, 0): 0}
    queue = [(initial, 0)]
    found = []
    for state, level in queue:
        row = []
        for edge in rows[state]:
            ahead = level
            while ahead < len(sets) and edge.marks >> sets[ahead] & 1:
                ahead += 1
            target = (edge.target, ahead % len(sets))
            if target not in number:
                number[target] = len(queue)
                queue.append(target)
            row.append((edge, number[target], ahead == len(sets)))
        if len(queue) > MAX_STATES:
            raise InputError(f"automaton: more than {MAX_STATES} states with one acceptance set")
        found.append(_joined(row))
    return tuple(found), 0


def _joined(row: list[tuple[_Edge, int, bool]]) -> tuple[Transition, ...]:
    """Join the edges with the same target and acceptance into one guarded transition."""
    guards: dict[tuple[int, bool], list[Guard]] = {}
    for edge, target, accepting in row:
        guards.setdefault((target, accepting), []).append(edge.guard)
    return tuple(
        Transition(_either(group), target, accepting)
        for (target, accepting), group in guards.items()
    )


def _either(guards: list[Guard]) -> Guard:
    """Return the disjunction of guards that are each as simple as they get."""
    if len(guards) == 1:
        return guards[0]
    return simplified(cube for guard in guards for cube in guard.cubes)
