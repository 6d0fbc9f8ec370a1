"""From a task to the optimal local plan, or to the reason why there is none.

- ``plan_task``     the plan for a formula
- ``told``          the plan that a lasso is
- ``region_named``  what a place is called
"""

from collections.abc import Sequence

from tlcomm_core.ltl import BuchiAutomaton, Formula, translate
from tlcomm_core.planning import product as products
from tlcomm_core.planning.failure import failure
from tlcomm_core.planning.lasso import SUFFIX_FIRST, Lasso, Objective, optimal_lasso
from tlcomm_core.planning.plan import LocalPlan, PlanStep
from tlcomm_core.planning.product import Product
from tlcomm_core.planning.transition_system import TransitionSystem

__all__ = ["plan_task", "region_named", "told"]


def plan_task(
    formula: Formula, system: TransitionSystem, objective: Objective = SUFFIX_FIRST
) -> LocalPlan:
    """Return the optimal local plan of an agent for its task.

    The plan's steps are those of the transition system; the initial state, whose label the word
    begins with, is none of them. The suffix begins where the prefix enters the best cycle first,
    so its satisfying step needn't be the last.

    Args:
        formula: the task.
        system: the agent's transition system.
        objective: what is to be least.

    Raises:
        UnsatisfiableTaskError: no word satisfies the formula.
        UnreachableTaskError: some word does, but none of a run of the system.

    Source: Section IV-A.
    Cost: see ``translate``, ``product.build`` and ``optimal_lasso``.
    """
    automaton = translate(formula)
    product = products.build(system, automaton)
    lasso = optimal_lasso(product, objective)
    if lasso is None:
        raise failure(formula, automaton, system)
    return told(lasso, product, system, automaton)


def told(
    lasso: Lasso, product: Product, system: TransitionSystem, automaton: BuchiAutomaton
) -> LocalPlan:
    """Return the plan that a lasso of the product is."""
    prefix = _steps(lasso.prefix, product, system, automaton)
    suffix = _steps(lasso.suffix, product, system, automaton)
    first = next(place for place, step in enumerate(suffix) if step.satisfies)
    return LocalPlan(
        prefix=prefix,
        suffix=suffix,
        prefix_s=_total_s(lasso.prefix, product, system),
        suffix_s=_total_s(lasso.suffix, product, system),
        first_s=_total_s((*lasso.prefix, *lasso.suffix[: first + 1]), product, system),
        prefix_m=_total_m(lasso.prefix, product, system),
        suffix_m=_total_m(lasso.suffix, product, system),
        initial_label=system.labels[system.initial_label],
    )


def _steps(
    edges: Sequence[int], product: Product, system: TransitionSystem, automaton: BuchiAutomaton
) -> tuple[PlanStep, ...]:
    return tuple(_step(edge, product, system, automaton) for edge in edges)


def _step(
    edge: int, product: Product, system: TransitionSystem, automaton: BuchiAutomaton
) -> PlanStep:
    step = int(product.step[edge])
    location = system.states[system.target[step]].location
    return PlanStep(
        region=region_named(system.regions[location], automaton.atoms),
        location=location,
        action=system.actions[system.action[step]],
        duration_s=float(system.stay_s[step]),
        label=system.labels[system.label[step]],
        satisfies=bool(product.accepting[edge]),
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
