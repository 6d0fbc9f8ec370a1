"""Translate a formula of linear temporal logic into a Büchi automaton, and tell what it is."""

from argparse import ArgumentParser, Namespace
from typing import Any, Final

from tlcomm_core.errors import FormulaError, InputError
from tlcomm_core.ltl import (
    BuchiAutomaton,
    Formula,
    LassoWord,
    Profile,
    contradiction,
    explain,
    known_conflict,
    parse,
    profile,
    to_dot,
    to_hoa,
    to_text,
    translate,
    word_text,
)
from tlcomm_tools.status import Status
from tlcomm_tools.verbs.options import print_json

__all__ = ["EXAMPLE", "add_arguments", "run"]

EXAMPLE: Final = "tlcomm ltl 'G F (a & F b)' --hoa"

_ACCEPTANCE: Final = "Büchi acceptance on transitions"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument("formula", metavar="FORMULA", help="for example 'G F (a & F b)'")
    kinds = parser.add_mutually_exclusive_group()
    kinds.add_argument("--hoa", action="store_true", help="in the Hanoi Omega-Automata format v1")
    kinds.add_argument("--dot", action="store_true", help="as a Graphviz drawing")
    kinds.add_argument(
        "--explain",
        action="store_true",
        help="tell the formula's class, and words that satisfy and violate it",
    )


def run(options: Namespace) -> Status:
    """Translate the formula."""
    try:
        formula = parse(options.formula)
    except FormulaError as error:
        raise InputError(f"formula: {explain(error)}") from error
    known = profile(formula) if options.explain else None
    automaton = translate(formula) if known is None else known.automaton
    if options.hoa and not options.json:
        print(to_hoa(automaton, formula), end="")
    elif options.dot and not options.json:
        print(to_dot(automaton, to_text(formula)), end="")
    else:
        conflict = _conflict(formula, automaton) if known is None else known.conflict
        if options.json:
            print_json(_document(formula, automaton, conflict, known))
        else:
            print("\n".join(_lines(formula, automaton, conflict, known)))
    return Status.FINE


def _conflict(formula: Formula, automaton: BuchiAutomaton) -> tuple[Formula, ...]:
    return known_conflict(formula) if automaton.is_empty() else ()


def _document(
    formula: Formula,
    automaton: BuchiAutomaton,
    conflict: tuple[Formula, ...],
    known: Profile | None,
) -> dict[str, Any]:
    document: dict[str, Any] = {
        "format": "tlcomm-automaton/1",
        "formula": to_text(formula),
        "atoms": list(automaton.atoms),
        "construction": automaton.kind.value,
        "states": automaton.state_count,
        "transitions": _transition_count(automaton),
        "conflict": list(map(to_text, conflict)),
        "hoa": to_hoa(automaton, formula),
        "dot": to_dot(automaton, to_text(formula)),
    }
    if known is not None:
        document["explanation"] = _explanation(automaton, known)
    return document


def _explanation(automaton: BuchiAutomaton, known: Profile) -> dict[str, Any]:
    undecided = known.undecided
    return {
        "satisfiability": _satisfiability(known),
        "class": known.temporal_class.name.lower().replace("_", "-"),
        "deterministic": automaton.is_deterministic(),
        "satisfied": _word(known.satisfying),
        "violated": _word(known.violating),
        "not_yet": None
        if undecided is None
        else {"letters": list(map(sorted, undecided.letters)), "verdict": undecided.verdict.value},
    }


def _word(word: LassoWord | None) -> dict[str, Any] | None:
    if word is None:
        return None
    return {"stem": list(map(sorted, word.stem)), "loop": list(map(sorted, word.loop))}


def _lines(
    formula: Formula,
    automaton: BuchiAutomaton,
    conflict: tuple[Formula, ...],
    known: Profile | None,
) -> list[str]:
    transitions = _transition_count(automaton)
    lines = [
        f"formula       {to_text(formula)}",
        f"atoms         {', '.join(automaton.atoms) or '–'}",
        f"construction  {automaton.kind.value}",
        f"automaton     {automaton.state_count} states, {transitions} transitions, {_ACCEPTANCE}",
    ]
    if conflict:
        lines.append(f"conflict      {contradiction(conflict)}")
    if known is None:
        return [*lines, "(--hoa or --dot show it, --explain tells more)"]
    return [*lines, *_explained_lines(automaton, known)]


def _explained_lines(automaton: BuchiAutomaton, known: Profile) -> list[str]:
    undecided = known.undecided
    not_yet = undecided and f"{word_text(undecided.letters)} … ({undecided.verdict.value})"
    return [
        f"deterministic {'yes' if automaton.is_deterministic() else 'no'}",
        f"class         {known.temporal_class.value}",
        f"formula is    {_satisfiability(known)}",
        f"satisfied by  {known.satisfying or 'no word'}",
        f"violated by   {known.violating or 'no word'}",
        f"not yet       {not_yet or 'no word'}",
    ]


def _satisfiability(known: Profile) -> str:
    if known.satisfying is None:
        return "unsatisfiable"
    return "valid" if known.violating is None else "satisfiable"


def _transition_count(automaton: BuchiAutomaton) -> int:
    return sum(map(len, automaton.transitions))
