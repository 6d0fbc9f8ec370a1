"""Why a task has no plan.

- ``failure``    the error that names the parts of the task that can't be had, and from where
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from tlcomm_core.errors import (
    IntractableTaskError,
    PlanningError,
    UnreachableTaskError,
    UnsatisfiableTaskError,
)
from tlcomm_core.ltl import (
    BuchiAutomaton,
    Construction,
    Cube,
    Formula,
    Guard,
    conjunction,
    conjuncts,
    contradiction,
    known_conflict,
    negation_normal_form,
    smallest_conflict,
    translate,
)
from tlcomm_core.ltl.finite import FiniteReading
from tlcomm_core.ltl.normal_form import is_timeless
from tlcomm_core.planning.product import Product, build
from tlcomm_core.planning.quotient import quotient
from tlcomm_core.planning.transition_system import TransitionSystem

__all__ = ["failure"]

Label = frozenset[str]


def failure(
    task: Formula | BuchiAutomaton, automaton: BuchiAutomaton, system: TransitionSystem
) -> PlanningError:
    """Return the error that says why no run of the system satisfies a task.

    It names a smallest set of conjuncts that can't be had together, and what they lack: a region
    or an action that is never to be had, or a place where several things are true at once. Names
    that aren't actions of the system count as regions.

    Args:
        task: one without a plan; a given automaton is blamed as a whole.
        automaton: the task's.
        system: the agent's transition system.

    Cost: ``smallest_conflict`` with a translation and a search of the system's quotient each.
    """
    if isinstance(task, BuchiAutomaton):
        if task.is_empty():
            return UnsatisfiableTaskError("the automaton contradicts itself: no word fits it")
        return UnreachableTaskError(f"the automaton can't be done: {_reason((), task, system)}")
    if automaton.is_empty() and automaton.kind is not Construction.FOR_LETTERS:
        return UnsatisfiableTaskError(contradiction(known_conflict(task)))
    words = quotient(system)
    every = conjuncts(task)
    parts = smallest_conflict(every, lambda chosen: _is_possible(chosen, words))
    blamed = automaton if parts == every else translate(conjunction(parts), system.labels)
    quoted = " and ".join(repr(str(part)) for part in parts)
    together = " together" if len(parts) > 1 else ""
    return UnreachableTaskError(
        f"{quoted} can't be done{together}: {_reason(parts, blamed, system)}"
    )


def _is_possible(parts: Sequence[Formula], system: TransitionSystem) -> bool:
    """Return whether a run satisfies all parts; what can't be translated isn't blamed."""
    try:
        automaton = translate(conjunction(parts), system.labels)
    except IntractableTaskError:
        return True
    return _has_accepting_cycle(build(system, automaton))


def _has_accepting_cycle(product: Product) -> bool:
    shape = (product.size, product.size)
    edges = coo_array((np.ones(len(product.source)), (product.source, product.target)), shape)
    _, component = connected_components(edges.tocsr(), directed=True, connection="strong")
    is_inner = component[product.source] == component[product.target]
    return bool((product.accepting & is_inner).any())


def _reason(parts: Sequence[Formula], automaton: BuchiAutomaton, system: TransitionSystem) -> str:
    """Return what parts that aren't possible, and their automaton, lack."""
    pose = system.states[0].pose
    start = f"({pose.x_m:g}, {pose.y_m:g})"
    # An automaton made for the system's letters alone may be empty, and then says no more.
    if not automaton.is_empty():
        possible = Label().union(*system.labels)
        never = [atom for atom in automaton.atoms if atom not in possible]
        if _without(automaton, never).is_empty():
            culprits = [atom for atom in never if _without(automaton, [atom]).is_empty()] or never
            return " and ".join(_absence(atom, system, start) for atom in culprits)
        if _limited_to(automaton, system.labels).is_empty():
            return f"{_unmet(parts, system)} at any place that can be reached from {start}"
    regions = " and ".join(map(repr, sorted(system.labels[system.initial_label]))) or "no region"
    return f"no order of visits and actions fits that begins at {start}, in {regions}"


def _absence(atom: str, system: TransitionSystem, start: str) -> str:
    if atom in system.actions:
        return f"action {atom!r} isn't possible at any place that can be reached from {start}"
    return f"region {atom!r} can't be reached from {start}: every way is blocked"


def _unmet(parts: Sequence[Formula], system: TransitionSystem) -> str:
    """Say what no letter is like."""
    nowhere = [repr(str(wish)) for wish in _wishes(parts) if not _is_met(wish, system.labels)]
    if nowhere:
        return f"{' and '.join(nowhere)} can't be had"
    return "what they want true and what they want false can't be had at once"


def _wishes(parts: Iterable[Formula]) -> Iterator[Formula]:
    """Yield the largest formulas about one letter alone that parts are made of."""
    for part in parts:
        stack = [negation_normal_form(part)]
        while stack:
            node = stack.pop()
            if is_timeless(node):
                yield node
            else:
                stack += reversed(node.children)


def _is_met(wish: Formula, labels: Iterable[Label]) -> bool:
    """Return whether some letter satisfies a formula about one letter."""
    return any(_is_satisfied(wish, label) for label in labels)


def _is_satisfied(wish: Formula, label: Label) -> bool:
    reading = FiniteReading(wish)
    reading.read(label)
    return reading.is_satisfied


def _without(automaton: BuchiAutomaton, never: Sequence[str]) -> BuchiAutomaton:
    """Return the automaton for words in which some atoms are always false."""
    return _with_cubes(automaton, lambda cube: cube.required.isdisjoint(never))


def _limited_to(automaton: BuchiAutomaton, labels: Sequence[Label]) -> BuchiAutomaton:
    """Return the automaton for words of some labels."""
    return _with_cubes(automaton, lambda cube: any(cube.holds(label) for label in labels))


def _with_cubes(automaton: BuchiAutomaton, keeps: Callable[[Cube], bool]) -> BuchiAutomaton:
    """Return the automaton with some cubes of its guards alone."""
    transitions = tuple(
        tuple(replace(edge, guard=Guard(tuple(filter(keeps, edge.guard.cubes)))) for edge in edges)
        for edges in automaton.transitions
    )
    return replace(automaton, transitions=transitions)
