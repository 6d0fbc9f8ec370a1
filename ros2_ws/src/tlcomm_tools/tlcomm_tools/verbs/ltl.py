"""Translate a formula of linear temporal logic into a Büchi automaton."""

from argparse import ArgumentParser, Namespace
from typing import Final

from tlcomm_core.errors import FormulaError, InputError
from tlcomm_core.ltl import explain, parse, to_dot, to_hoa, to_text, translate
from tlcomm_tools.status import Status
from tlcomm_tools.verbs.options import print_json

__all__ = ["EXAMPLE", "add_arguments", "run"]

EXAMPLE: Final = "tlcomm ltl 'G F (a & F b)' --hoa"


def add_arguments(parser: ArgumentParser) -> None:
    """Add the verb's arguments."""
    parser.add_argument("formula", metavar="FORMULA", help="for example 'G F (a & F b)'")
    kinds = parser.add_mutually_exclusive_group()
    kinds.add_argument("--hoa", action="store_true", help="in the Hanoi Omega-Automata format v1")
    kinds.add_argument("--dot", action="store_true", help="as a Graphviz drawing")


def run(options: Namespace) -> Status:
    """Translate the formula."""
    try:
        formula = parse(options.formula)
    except FormulaError as error:
        raise InputError(f"formula: {explain(error)}") from error
    automaton = translate(formula)
    hoa, dot = to_hoa(automaton, formula), to_dot(automaton, to_text(formula))
    transitions = sum(len(edges) for edges in automaton.transitions)
    if options.json:
        print_json(
            {
                "format": "tlcomm-automaton/1",
                "formula": to_text(formula),
                "atoms": list(automaton.atoms),
                "construction": automaton.kind.value,
                "states": automaton.state_count,
                "transitions": transitions,
                "hoa": hoa,
                "dot": dot,
            }
        )
    elif options.hoa:
        print(hoa, end="")
    elif options.dot:
        print(dot, end="")
    else:
        print(
            f"formula       {to_text(formula)}\n"
            f"atoms         {', '.join(automaton.atoms) or '–'}\n"
            f"construction  {automaton.kind.value}\n"
            f"automaton     {automaton.state_count} states, {transitions} transitions, "
            "Büchi acceptance on transitions\n"
            "(--hoa or --dot show it)"
        )
    return Status.FINE
