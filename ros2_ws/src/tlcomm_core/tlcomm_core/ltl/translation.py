"""The Büchi automaton that planning uses for a formula.

- ``translate``   chooses the construction
"""

from collections.abc import Collection
from dataclasses import replace

from tlcomm_core.errors import IntractableTaskError
from tlcomm_core.ltl.assembly import assembled
from tlcomm_core.ltl.automaton import BuchiAutomaton, Construction
from tlcomm_core.ltl.formula import Formula, atoms, conjunction
from tlcomm_core.ltl.good_prefix import restarted
from tlcomm_core.ltl.graph import Edge, Graph
from tlcomm_core.ltl.guard import Cube
from tlcomm_core.ltl.normal_form import (
    conjoined,
    is_co_safe,
    is_timeless,
    negation_normal_form,
    recurring,
)
from tlcomm_core.ltl.recurrence import FEW
from tlcomm_core.ltl.tableau import tableau_parts

__all__ = ["translate"]


def translate(
    formula: Formula, letters: Collection[frozenset[str]] | None = None
) -> BuchiAutomaton:
    """Return a Büchi automaton of the words that satisfy a formula.

    □◇φ with syntactically co-safe φ (however it is written) becomes φ's good-prefix automaton,
    begun anew after each acceptance, so that a cycle through one accepting transition is one
    satisfaction of φ. Where such formulas are conjoined, with each other or with any other
    formulas, each keeps its restarted automaton, and an accepting transition ends a stretch in
    which each was satisfied at least once. Every other formula goes through the tableau, and so do
    five or more □◇β with β free of operators of time. The result's ``kind`` says which it was.

    Args:
        formula: any.
        letters: the letters that can occur, if that is known. Where a conjunction's automaton is
            too large, the one for words of these letters is made instead; it has no transitions
            on others.

    Raises:
        IntractableTaskError: the automaton would be too large.
    Source: the class □◇φ^s of Section III-A.
    Cost: see ``restarted``, ``tableau_automaton`` and ``degeneralized`` (in any order).
    """
    conjuncts = conjoined(negation_normal_form(formula))
    tasks = _tasks(conjuncts)
    if tasks and len(conjuncts) == 1:
        return restarted(*tasks.values())
    names = atoms(formula)
    rest = conjunction(node for node in conjuncts if node not in tasks) if tasks else formula
    parts = tableau_parts(rest, names)
    repeated = (_graph(restarted(task), names) for task in tasks.values())
    parts = replace(parts, graphs=(*repeated, *parts.graphs))
    kind = Construction.COMPOSED if tasks else Construction.TABLEAU
    try:
        return assembled(parts, kind, any_order=bool(tasks))
    except IntractableTaskError:
        if letters is None or len(parts.graphs) == 1:
            raise
    kind = Construction.FOR_LETTERS
    return assembled(parts, kind, any_order=bool(tasks), letters=letters)


def _tasks(parts: tuple[Formula, ...]) -> dict[Formula, Formula]:
    """Return φ for each conjunct □◇φ that gets an automaton of its own."""
    tasks = {node: task for node in parts if (task := recurring(node)) and is_co_safe(task)}
    brief = [node for node, task in tasks.items() if is_timeless(task)]
    if len(brief) > FEW:
        return {node: task for node, task in tasks.items() if node not in brief}
    return tasks


def _graph(automaton: BuchiAutomaton, names: tuple[str, ...]) -> Graph:
    place = {name: index for index, name in enumerate(names)}

    def literals(cube: Cube) -> int:
        required = sum(1 << 2 * place[name] for name in cube.required)
        return required | sum(2 << 2 * place[name] for name in cube.forbidden)

    assert automaton.initial == 0
    rows = (
        tuple(
            Edge(literals(cube), edge.target, int(edge.accepting))
            for edge in row
            for cube in edge.guard.cubes
        )
        for row in automaton.transitions
    )
    return Graph(tuple(rows), 1)
