"""Why a plan is optimal: what the best plans cost that do without a part of it.

- ``Move``          from where to where, and what is done there
- ``Rival``         the best plan whose suffix lacks one move of the optimal suffix
- ``Explanation``   the optimal plan and its rivals
- ``explain_plan``  makes it

Any other suffix either makes all of the optimal one's moves, be it with detours, or lacks one of
them. The best plan of the latter kind is called the second best.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Final

import numpy as np

from tlcomm_core.ltl import BuchiAutomaton, Formula, translate
from tlcomm_core.planning import product as products
from tlcomm_core.planning.failure import failure
from tlcomm_core.planning.lasso import SUFFIX_FIRST, Key, Lasso, Objective, optimal_lasso
from tlcomm_core.planning.on_the_fly import check_size
from tlcomm_core.planning.plan import LocalPlan
from tlcomm_core.planning.product import Product
from tlcomm_core.planning.relaxation import SoftTask
from tlcomm_core.planning.shortest_paths import Bools, Ints
from tlcomm_core.planning.synthesis import region_named, told
from tlcomm_core.planning.transition_system import TransitionSystem

__all__ = ["Explanation", "Move", "Rival", "explain_plan"]


@dataclass(frozen=True, slots=True)
class Move:
    """What a step does: all steps with the same move differ in how the agent is turned alone.

    Attributes:
        source: region that it leaves; empty for a place in none.
        target: region that it enters, the same for an action or staying put.
        action: what is done there, or ``None``.
    """

    source: str
    target: str
    action: str | None


@dataclass(frozen=True, slots=True)
class Rival:
    """The best plan whose suffix doesn't make one of the optimal suffix's moves.

    Attributes:
        without: the move.
        plan: the plan; ``None`` if every accepting suffix makes the move.
    """

    without: Move
    plan: LocalPlan | None


class Explanation:
    """The optimal plan of one product against the best ones of parts of it."""

    def __init__(
        self,
        product: Product,
        best: Lasso,
        system: TransitionSystem,
        automaton: BuchiAutomaton,
        objective: Objective,
        soft: SoftTask | None,
    ) -> None:
        """Note what there is; rivals are searched for when they are asked for.

        Args:
            product: of system and automaton.
            best: its optimal lasso.
            system: the agent's transition system.
            automaton: its task's.
            objective: what is least.
            soft: what the product relaxes, if anything.
        """
        self._product: Final = product
        self._best: Final = best
        self._system: Final = system
        self._automaton: Final = automaton
        self._objective: Final = objective
        self._soft: Final = soft
        self._move_of: Final = _moves(product, system)

    @cached_property
    def plan(self) -> LocalPlan:
        """The optimal plan."""
        return self._told(self._best)

    @cached_property
    def rivals(self) -> tuple[Rival, ...]:
        """One for each distinct move of the optimal suffix, in order.

        Cost: one search per distinct move, each on twice the product.
        """
        return tuple(
            Rival(self._told_move(move), None if lasso is None else self._told(lasso))
            for move, lasso in self._lassos.items()
        )

    @property
    def second_best(self) -> Rival | None:
        """The best of the rivals that have a plan, the first of equals.

        ``None`` if the optimal suffix is the only one, but for moves that could be added to it.
        """
        lassos = self._lassos.values()
        keys = [(self._key(lasso), place) for place, lasso in enumerate(lassos) if lasso]
        return self.rivals[min(keys)[1]] if keys else None

    @cached_property
    def _lassos(self) -> dict[int, Lasso | None]:
        """The best lasso without each move of the optimal suffix."""
        moves = dict.fromkeys(self._move_of[list(self._best.suffix)].tolist())
        return {move: self._best_without(move) for move in moves}

    def _best_without(self, move: int) -> Lasso | None:
        """Return the best lasso of the product whose suffix makes no edge of a move."""
        halves, origin = _with_suffixes_of(self._product, self._move_of != move)
        lasso = optimal_lasso(halves, self._objective)
        if lasso is None:
            return None
        prefix, suffix = (origin[list(edges)].tolist() for edges in (lasso.prefix, lasso.suffix))
        return Lasso(tuple(prefix), tuple(suffix))

    def _told(self, lasso: Lasso) -> LocalPlan:
        return told(lasso, self._product, self._system, self._automaton, self._soft)

    def _told_move(self, move: int) -> Move:
        """Return a move by the names of its regions, those that the task names first."""
        edge = int(np.flatnonzero(self._move_of == move)[0])
        step = int(self._product.step[edge])
        system, atoms = self._system, self._automaton.atoms
        source, target = (
            region_named(system.regions[system.states[int(ends[step])].location], atoms)
            for ends in (system.source, system.target)
        )
        return Move(source, target, system.actions[system.action[step]])

    def _key(self, lasso: Lasso) -> Key:
        suffix = list(lasso.suffix)
        until = int(self._product.accepting[suffix].argmax()) + 1
        first = [*lasso.prefix, *suffix[:until]]
        product, times_ns = self._product, self._product.time_ns
        start = np.searchsorted(product.initial, product.source[first[0]])
        first_ns = int(product.initial_ns[start] + times_ns[first].sum())
        return self._objective.key(first_ns, int(times_ns[suffix].sum()))


def explain_plan(
    task: Formula | BuchiAutomaton,
    system: TransitionSystem,
    objective: Objective = SUFFIX_FIRST,
    soft: SoftTask | None = None,
) -> Explanation:
    """Return the optimal plan and the best ones without each of its suffix's moves.

    Args:
        task: as for ``plan_task``.
        system: the agent's transition system.
        objective: what is least, for all of them.
        soft: as for ``plan_task``; what its violation costs counts.

    Raises:
        UnsatisfiableTaskError: no word satisfies the task.
        UnreachableTaskError: some word does, but none of a run of the system.
        IntractableTaskError: see ``translate``, ``check_size`` and ``product.build``.

    Cost: that of ``plan_task``, but for the whole product, however large.
    """
    automaton = task if isinstance(task, BuchiAutomaton) else translate(task, system.labels)
    if soft is None:
        check_size(system, automaton)
    product = products.build(system, automaton, soft)
    best = optimal_lasso(product, objective)
    if best is None:
        raise failure(task, automaton, system)
    return Explanation(product, best, system, automaton, objective, soft)


def _moves(product: Product, system: TransitionSystem) -> Ints:
    """Return the number of each edge's move, int[E]: equal exactly for equal moves."""
    location = np.array([state.location for state in system.states])
    ends = location[system.source], location[system.target], system.action
    _, number = np.unique(np.column_stack(ends), axis=0, return_inverse=True)
    moves: Ints = number.ravel()[product.step]
    return moves


def _with_suffixes_of(product: Product, allowed: Bools) -> tuple[Product, Ints]:
    """Return a product of all prefixes, but with some edges alone in suffixes.

    It is the product twice: a run goes over to the second half whenever it likes, there only the
    allowed edges are left, and only they accept.

    Returns:
        The product, and for each of its edges the one that it stands for.
    """
    every, inner = np.arange(len(product.source)), np.flatnonzero(allowed)
    origin = np.concatenate((every, every, inner))
    leaves_second = np.repeat((0, 0, 1), (len(every), len(every), len(inner)))
    enters_second = np.repeat((0, 1, 1), (len(every), len(every), len(inner)))
    halves = replace(
        product,
        size=2 * product.size,
        initial=np.concatenate((product.initial, product.initial + product.size)),
        source=product.source[origin] + product.size * leaves_second,
        target=product.target[origin] + product.size * enters_second,
        step=product.step[origin],
        accepting=product.accepting[origin] & (leaves_second > 0),
        time_ns=product.time_ns[origin],
        initial_ns=np.tile(product.initial_ns, 2),
        reading=replace(
            product.reading,
            initial=np.tile(product.reading.initial, 2),
            edge=product.reading.edge[origin],
        ),
    )
    return halves, origin
