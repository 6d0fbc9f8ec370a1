"""A task's automaton alone, or beside that of a soft task, which may be violated at a price.

- ``SoftTask``   an automaton that need not be obeyed, and what violating it costs
- ``soft_task``  makes one
- ``Move``       what reading one letter leads to
- ``Reader``     what the product asks
- ``Strict``     the task alone
- ``Relaxed``    the task, and the soft one relaxed
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final, NamedTuple, Protocol

from tlcomm_core.errors import LocalMisuseError, UnsatisfiableTaskError
from tlcomm_core.ltl import BuchiAutomaton, Formula, Guard, translate

__all__ = ["Automaton", "Move", "Reader", "Relaxed", "SoftTask", "Strict", "soft_task"]

Label = frozenset[str]


class Automaton(Protocol):
    """A Büchi automaton with acceptance on transitions, nondeterministic or not."""

    @property
    def atoms(self) -> tuple[str, ...]:
        """Names that it reads."""
        ...

    @property
    def initial(self) -> int:
        """State before the first letter."""
        ...

    @property
    def state_count(self) -> int:
        """Number of states."""
        ...

    def successors(self, state: int, label: Label) -> tuple[tuple[int, bool], ...]:
        """Return (target, accepting) of each transition that a letter allows."""
        ...


@dataclass(frozen=True, slots=True)
class SoftTask:
    """A task to be satisfied as much as possible.

    Attributes:
        automaton: the words that satisfy it; not empty.
        weight_s: price of each atom of a letter that would have to be different, in s, > 0.
    """

    automaton: BuchiAutomaton
    weight_s: float


class Move(NamedTuple):
    """What reading a letter leads to.

    Attributes:
        target: the reader's next state.
        accepting: whether it must be so again and again.
        satisfies: whether the task's automaton takes an accepting transition.
        wanted: literals that the soft task would have needed: atoms that should have been true
            and, with ! before them, atoms that should have been false.
    """

    target: int
    accepting: bool
    satisfies: bool
    wanted: tuple[str, ...] = ()


class Reader(Protocol):
    """Automata reading the letters of a run together."""

    @property
    def atoms(self) -> Label:
        """Names that it reads."""
        ...

    @property
    def initial(self) -> int:
        """State before the first letter."""
        ...

    @property
    def state_count(self) -> int:
        """Number of states."""
        ...

    def moves(self, state: int, label: Label) -> Iterator[Move]:
        """Yield what a letter may lead to; of moves that differ in ``wanted`` alone, one."""
        ...


def soft_task(formula: Formula, weight_s: float) -> SoftTask | None:
    """Return a soft task, or None if violating it costs nothing: then it is ignored.

    Raises:
        LocalMisuseError: the weight is negative.
        UnsatisfiableTaskError: no word satisfies the formula, however it were corrected.
        IntractableTaskError: its automaton would be too large.
    """
    if not weight_s >= 0.0:
        message = f"weight of a soft task is {weight_s!r} s, expected ≥ 0"
        raise LocalMisuseError(message)
    if weight_s == 0.0:
        return None
    automaton = translate(formula)
    if automaton.is_empty():
        what = f"soft task {str(formula)!r} contradicts itself: no word fits it"
        raise UnsatisfiableTaskError(what)
    return SoftTask(automaton, weight_s)


class Strict:
    """A task's automaton, to be obeyed."""

    def __init__(self, automaton: Automaton) -> None:
        """Take the automaton as it is."""
        self._automaton: Final = automaton
        self.atoms: Final = frozenset(automaton.atoms)
        self.initial: Final = automaton.initial
        self.state_count: Final = automaton.state_count

    def moves(self, state: int, label: Label) -> Iterator[Move]:
        """Yield the automaton's transitions."""
        for target, accepting in self._automaton.successors(state, label):
            yield Move(target, accepting, accepting)


class Relaxed:
    """A task's automaton, to be obeyed, and a soft one whose guards needn't hold.

    The soft automaton may take any of its transitions that some letter allows. What it reads then
    is the nearest such letter, so that a run's violations are the least number of atoms, over all
    letters, that would have to be different for the soft task to be satisfied.

    A state is (task's state h, soft state q, waiting r) with the number (h·|Q| + q)·2 + r. An
    accepting move is one of the task's accepting transitions, taken when not waiting. After it one
    waits until the soft automaton accepts, be it on that very move. When not waiting, one may also
    go on without an accepting move. So through each of the task's accepting transitions on a cycle
    on which both automata accept, in whatever order, there is a cycle of the product with the same
    steps, and a prefix that the soft automaton's acceptance doesn't delay.

    Source: Guo and Dimarogonas, "Multi-agent plan reconfiguration under local LTL specifications",
        2015, relaxed product automaton (h, q, r: q₁, q₂, c; price: distance from letter to guard).
    Deviates: acceptance is on transitions; c may wait, which makes the least lasso exact.
    """

    def __init__(self, automaton: Automaton, soft: BuchiAutomaton) -> None:
        """Put the automata side by side."""
        self._hard: Final = automaton
        self._soft: Final = soft
        self._soft_atoms: Final = frozenset(soft.atoms)
        self._options: Final[dict[tuple[int, Label], tuple[_Option, ...]]] = {}
        self.atoms: Final = frozenset(automaton.atoms) | self._soft_atoms
        self.initial: Final = self._number(automaton.initial, soft.initial, is_waiting=False)
        self.state_count: Final = automaton.state_count * soft.state_count * 2

    def moves(self, state: int, label: Label) -> Iterator[Move]:
        """Yield the task's transitions that a letter allows, each with every one of the soft's."""
        pair, was_waiting = divmod(state, 2)
        hard_state, soft_state = divmod(pair, self._soft.state_count)
        cheapest: dict[tuple[int, bool], Move] = {}
        for hard_target, satisfies in self._hard.successors(hard_state, label):
            # Options come the cheapest first.
            for option in self._of(soft_state, label):
                turns = _turns(
                    was_waiting=was_waiting > 0, satisfies=satisfies, complies=option.accepting
                )
                for accepting, is_waiting in turns:
                    target = self._number(hard_target, option.target, is_waiting=is_waiting)
                    move = Move(target, accepting, satisfies, option.wanted)
                    cheapest.setdefault((target, accepting), move)
        yield from cheapest.values()

    def _number(self, hard_state: int, soft_state: int, *, is_waiting: bool) -> int:
        return (hard_state * self._soft.state_count + soft_state) * 2 + is_waiting

    def _of(self, state: int, label: Label) -> "tuple[_Option, ...]":
        key = (state, label & self._soft_atoms)
        found = self._options.get(key)
        if found is None:
            found = self._options[key] = _cheapest(self._soft, *key)
        return found


class _Option(NamedTuple):
    """A transition of the soft automaton, and what its guard wants of the letter."""

    target: int
    accepting: bool
    wanted: tuple[str, ...]


def _turns(*, was_waiting: bool, satisfies: bool, complies: bool) -> tuple[tuple[bool, bool], ...]:
    """Return (accepting, waiting afterwards) for what task and soft task accept on a move."""
    if was_waiting or not satisfies:
        return ((False, was_waiting and not complies),)
    return ((True, False),) if complies else ((True, True), (False, False))


def _cheapest(automaton: BuchiAutomaton, state: int, label: Label) -> tuple[_Option, ...]:
    """Return the transitions out of a state that may be worth their price, the cheapest first.

    Of those to one target that is the cheapest, and the cheapest accepting one if that is another.
    """
    options = [
        _Option(edge.target, edge.accepting, _wanted(edge.guard, label))
        for edge in automaton.transitions[state]
        if edge.guard.cubes
    ]
    options.sort(key=lambda option: (len(option.wanted), not option.accepting))
    best: dict[int, list[_Option]] = {}
    for option in options:
        kept = best.setdefault(option.target, [])
        if not kept or (option.accepting and not any(other.accepting for other in kept)):
            kept.append(option)
    return tuple(option for option in options if option in best[option.target])


def _wanted(guard: Guard, label: Label) -> tuple[str, ...]:
    """Return the fewest literals in which a letter must change to pass a guard with cubes."""
    return min(
        (
            (*sorted(cube.required - label), *(f"!{a}" for a in sorted(cube.forbidden & label)))
            for cube in guard.cubes
        ),
        key=len,
    )
