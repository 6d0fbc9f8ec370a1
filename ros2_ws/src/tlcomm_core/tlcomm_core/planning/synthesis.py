"""From a task to the optimal local plan, or to the reason why there is none.

- ``plan_task``     the plan for a formula, or for an automaton
- ``told``          the plan that a lasso is
- ``region_named``  what a place is called
"""

from collections.abc import Sequence

import numpy as np

from tlcomm_core.ltl import BuchiAutomaton, Formula, translate
from tlcomm_core.planning import product as products
from tlcomm_core.planning.failure import failure
from tlcomm_core.planning.lasso import SUFFIX_FIRST, Lasso, Objective, optimal_lasso
from tlcomm_core.planning.on_the_fly import essential_part, is_large
from tlcomm_core.planning.plan import LocalPlan, PlanStep
from tlcomm_core.planning.product import Product
from tlcomm_core.planning.relaxation import Move, SoftTask
from tlcomm_core.planning.transition_system import TransitionSystem

__all__ = ["plan_task", "region_named", "told"]


def plan_task(
    task: Formula | BuchiAutomaton,
    system: TransitionSystem,
    objective: Objective = SUFFIX_FIRST,
    soft: SoftTask | None = None,
) -> LocalPlan:
    """Return the optimal local plan of an agent for its task.

    The plan's steps are those of the transition system; the initial state, whose label the word
    begins with, is none of them. The suffix begins where the prefix enters the best cycle first,
    so its satisfying step needn't be the last.

    Args:
        task: the formula; or an automaton, which is used as it is.
        system: the agent's transition system.
        objective: what is to be least.
        soft: what is to be satisfied beside the task, as much as is worth its price. Violating it
            adds to the times that the objective speaks about, and the suffix accepts both.

    Raises:
        UnsatisfiableTaskError: no word satisfies the task.
        UnreachableTaskError: some word does, but none of a run of the system.

        IntractableTaskError: see ``translate`` and ``essential_part``.

    Source: Section IV-A; with a soft task, see ``Relaxed``.
    Cost: see ``translate``, ``product.build`` and ``optimal_lasso``; for products that may have
        more than ``MOST_HELD`` edges ``essential_part`` comes first, unless there is a soft task.
    """
    automaton = task if isinstance(task, BuchiAutomaton) else translate(task, system.labels)
    part = system
    if soft is None and is_large(system, automaton):
        part = essential_part(system, automaton, objective)
    product = products.build(part, automaton, soft)
    lasso = optimal_lasso(product, objective)
    if lasso is None:
        raise failure(task, automaton, system)
    return told(lasso, product, part, automaton, soft)


def told(
    lasso: Lasso,
    product: Product,
    system: TransitionSystem,
    automaton: BuchiAutomaton,
    soft: SoftTask | None = None,
) -> LocalPlan:
    """Return the plan that a lasso of the product is."""
    entry = product.source[[*lasso.prefix, *lasso.suffix][0]]
    lasso = _shortened(lasso, product)
    prefix = _steps(lasso.prefix, product, system, automaton)
    suffix = _steps(lasso.suffix, product, system, automaton)
    first = next(place for place, step in enumerate(suffix) if step.satisfies)
    start = np.searchsorted(product.initial, entry)
    return LocalPlan(
        prefix=prefix,
        suffix=suffix,
        prefix_s=_total_s(lasso.prefix, product, system),
        suffix_s=_total_s(lasso.suffix, product, system),
        first_s=_total_s((*lasso.prefix, *lasso.suffix[: first + 1]), product, system),
        prefix_m=_total_m(lasso.prefix, product, system),
        suffix_m=_total_m(lasso.suffix, product, system),
        initial_label=system.labels[system.initial_label],
        initial_wanted=product.reading.moves[product.reading.initial[start]].wanted,
        weight_s=None if soft is None else soft.weight_s,
    )


def _shortened(lasso: Lasso, product: Product) -> Lasso:
    """Return the same run with the shortest prefix, however the automata count their turns."""

    def seen(edge: int) -> tuple[int, Move]:
        move = product.reading.moves[product.reading.edge[edge]]
        return int(product.step[edge]), move._replace(target=0, accepting=False)

    prefix, suffix = lasso.prefix, lasso.suffix
    while prefix and seen(prefix[-1]) == seen(suffix[-1]):
        prefix, suffix = prefix[:-1], (suffix[-1], *suffix[:-1])
    return Lasso(prefix, suffix)


def _steps(
    edges: Sequence[int], product: Product, system: TransitionSystem, automaton: BuchiAutomaton
) -> tuple[PlanStep, ...]:
    return tuple(_step(edge, product, system, automaton) for edge in edges)


def _step(
    edge: int, product: Product, system: TransitionSystem, automaton: BuchiAutomaton
) -> PlanStep:
    step = int(product.step[edge])
    location = system.states[system.target[step]].location
    move = product.reading.moves[product.reading.edge[edge]]
    return PlanStep(
        region=region_named(system.regions[location], automaton.atoms),
        location=location,
        action=system.actions[system.action[step]],
        duration_s=float(system.stay_s[step]),
        label=system.labels[system.label[step]],
        satisfies=move.satisfies,
        wanted=move.wanted,
    )


def region_named(names: Sequence[str], atoms: Sequence[str]) -> str:
    """Return the first of a place's regions that the task names, else the first, else ``""``."""
    return next((name for name in names if name in atoms), names[0] if names else "")


def _total_s(edges: Sequence[int], product: Product, system: TransitionSystem) -> float:
    """Return the time of some edges, added up in the order in which they are executed."""
    steps = product.step[list(edges)]
    return float(sum((system.drive_s[steps] + system.stay_s[steps]).tolist()))


def _total_m(edges: Sequence[int], product: Product, system: TransitionSystem) -> float:
    """Return the length of the way of some edges."""
    return float(system.drive_m[product.step[list(edges)]].sum())
