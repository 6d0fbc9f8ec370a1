"""The good prefixes of a co-safe formula, and the automaton that reads them again and again.

- ``GoodPrefixAutomaton``     deterministic, complete and minimal
- ``good_prefix_automaton``   the one of a syntactically co-safe formula
- ``restarted``               the Büchi automaton of □◇φ, begun anew after each satisfaction of φ

A *good prefix* of φ is a finite word all of whose continuations satisfy φ.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.ltl.automaton import BuchiAutomaton, Construction, Transition
from tlcomm_core.ltl.decision_diagram import DecisionDiagrams
from tlcomm_core.ltl.expansion import Expansion, antichain
from tlcomm_core.ltl.formula import Formula, Operator, atoms
from tlcomm_core.ltl.graph import check_size
from tlcomm_core.ltl.guard import Cube, simplified
from tlcomm_core.ltl.normal_form import is_co_safe, negation_normal_form

__all__ = ["GoodPrefixAutomaton", "good_prefix_automaton", "restarted"]

# Obligations {∅}: nothing is left to satisfy.
_SATISFIED: Final = (0,)


@dataclass(frozen=True, slots=True)
class GoodPrefixAutomaton:
    """The minimal deterministic, complete automaton of a formula's good prefixes.

    Attributes:
        atoms: names of the atoms that the guards may read.
        initial: the state of the empty prefix.
        satisfied: the state of every good prefix; None if there is none.
        transitions: per state its edges; an edge is accepting if it enters ``satisfied``.
    """

    atoms: tuple[str, ...]
    initial: int
    satisfied: int | None
    transitions: tuple[tuple[Transition, ...], ...]

    def step(self, state: int, label: frozenset[str]) -> int:
        """Return the state after one more letter, in which exactly ``label`` is true."""
        return next(edge.target for edge in self.transitions[state] if edge.guard.holds(label))

    def is_good(self, prefix: Iterable[frozenset[str]]) -> bool:
        """Return whether every continuation of the prefix satisfies the formula."""
        state = self.initial
        for label in prefix:
            state = self.step(state, label)
        return state == self.satisfied


def good_prefix_automaton(formula: Formula) -> GoodPrefixAutomaton:
    """Return the minimal deterministic automaton of a co-safe formula's good prefixes.

    A state is what is left to satisfy after the letters read so far, as a disjunction of sets of
    obligations of which none contains another: the formula's progression, modulo propositional
    equivalence. States from which satisfaction can't be avoided any more count as satisfied, and
    equal states are merged.

    Raises:
        LocalMisuseError: the formula isn't syntactically co-safe.
        IntractableTaskError: the automaton would be too large.
    Source: Bacchus and Kabanza, "Using temporal logics to express search control knowledge for
        planning", 2000 (progression); Kupferman and Vardi, "Model checking of safety properties",
        2001 (good prefixes); Moore, 1956 (merging).
    Cost: doubly exponential in the formula in the worst case, as the problem is; guards branch
        over the atoms that a state really reads.
    """
    if not is_co_safe(formula):
        message = f"{formula!r} isn't syntactically co-safe"
        raise LocalMisuseError(message)
    return _Determinization(negation_normal_form(formula)).run(atoms(formula))


def restarted(formula: Formula) -> BuchiAutomaton:
    """Return the Büchi automaton of □◇φ in which φ begins anew after each satisfaction.

    φ itself speaks about a word that begins at a given letter, while □◇φ asks that φ holds at
    positions without end, wherever they are. So what is read again and again are the good prefixes
    of ◇φ: the shortest stretch of letters, from the last satisfaction on, some suffix of which
    satisfies φ whatever follows. The transition that completes it is accepting and leads back to
    the initial state; the next letter begins the next satisfaction. As an ω-language this is □◇φ:
    endless completions prove ◇φ at positions without end, and if ◇φ always holds then each
    completion comes. What it adds is the count of satisfactions in the paper's sense: for
    a ∧ ◇(b ∧ ◇c) one satisfaction needs a, then b, then c, all after the last one, although
    □◇(a ∧ ◇(b ∧ ◇c)) as a mere language equals □◇a ∧ □◇b ∧ □◇c.

    The automaton is deterministic and complete. Where even the empty prefix of ◇φ is good (φ is
    true, say), every transition is accepting. Where φ is unsatisfiable, none is.

    Args:
        formula: φ, syntactically co-safe.

    Raises:
        LocalMisuseError: φ isn't syntactically co-safe.
        IntractableTaskError: the automaton would be too large.
    Source: the class □◇φ^s of Section III-A.
    Cost: that of ``good_prefix_automaton``.
    """
    prefixes = good_prefix_automaton(Formula(Operator.EVENTUALLY, (formula,)))
    kind = Construction.RESTARTED_GOOD_PREFIX
    if prefixes.initial == prefixes.satisfied:
        always = Transition(simplified([Cube(frozenset(), frozenset())]), 0, accepting=True)
        return BuchiAutomaton(prefixes.atoms, 0, ((always,),), kind)
    # The satisfied state, if any, is the last: dropping it leaves the others' numbers alone.
    kept = [s for s in range(len(prefixes.transitions)) if s != prefixes.satisfied]
    assert kept == list(range(len(kept)))
    rows = tuple(
        tuple(
            Transition(edge.guard, 0 if edge.accepting else edge.target, edge.accepting)
            for edge in prefixes.transitions[state]
        )
        for state in kept
    )
    return BuchiAutomaton(prefixes.atoms, prefixes.initial, rows, kind)


class _Determinization:
    """Builds the deterministic automaton: explore, find the settled states, merge, number."""

    def __init__(self, normal_form: Formula) -> None:
        self._expansion = Expansion(normal_form)
        self._diagrams = DecisionDiagrams()
        start = self._expansion.start
        self._left: list[tuple[int, ...]] = [() if start is None else antichain([start])]
        self._number = {self._left[0]: 0}

    def run(self, names: tuple[str, ...]) -> GoodPrefixAutomaton:
        """Return the minimal automaton over these atoms, its states numbered breadth first."""
        # The list of states grows while it is walked.
        roots = [self._successor(left) for left in self._left]
        settled = self._settled(roots)
        classes, merged, mapped = self._merged(roots, settled)
        root_of = dict(zip(classes, mapped, strict=True))
        satisfied = next((classes[state] for state in settled), None)
        order = _breadth_first(classes[0], root_of, merged, satisfied)
        number = {label: index for index, label in enumerate(order)}
        return GoodPrefixAutomaton(
            names,
            number[classes[0]],
            None if satisfied is None else number[satisfied],
            tuple(self._transitions(root_of[c], merged, number, satisfied) for c in order),
        )

    def _successor(self, left: tuple[int, ...]) -> int:
        """Return the diagram from letters to the number of the state that they lead to."""
        expansion = self._expansion
        demands = {
            expansion.demands(term) for obligations in left for term in expansion.terms(obligations)
        }
        expansion.spend(len(demands) ** 2 // 2)
        terms = antichain(demands)
        rules = {(expansion.literals(term), expansion.obligations(term)) for term in terms}
        return self._diagram(frozenset(rules))

    def _diagram(self, rules: frozenset[tuple[int, int]]) -> int:
        """Return the diagram of "the obligations of all rules whose literals hold"."""
        done: dict[frozenset[tuple[int, int]], int] = {}
        stack = [rules]
        while stack:
            current = stack[-1]
            if current in done:
                stack.pop()
                continue
            first = _first_atom(current)
            if first is None:
                done[current] = self._leaf(current)
                continue
            no = _assigned(current, first, value=False)
            yes = _assigned(current, first, value=True)
            missing = [rest for rest in (yes, no) if rest not in done]
            if missing:
                stack += missing
            else:
                done[current] = self._diagrams.branch(first, done[no], done[yes])
        return done[rules]

    def _leaf(self, rules: frozenset[tuple[int, int]]) -> int:
        left = antichain(obligations for literals, obligations in rules if not literals)
        if left not in self._number:
            self._number[left] = len(self._left)
            self._left.append(left)
            check_size(len(self._left), 0)
        return self._diagrams.leaf(self._number[left])

    def _settled(self, roots: list[int]) -> set[int]:
        """Return the states from which no endless run avoids the satisfied one."""
        settled = {self._number[_SATISFIED]} if _SATISFIED in self._number else set()
        unsettled_successors = {
            state: {target for target in self._diagrams.leaves(root) if target not in settled}
            for state, root in enumerate(roots)
            if state not in settled
        }
        sources: dict[int, list[int]] = {state: [] for state in unsettled_successors}
        for state, targets in unsettled_successors.items():
            for target in targets:
                sources[target].append(state)
        pending = [state for state, targets in unsettled_successors.items() if not targets]
        while pending:
            state = pending.pop()
            settled.add(state)
            for source in sources[state]:
                unsettled_successors[source].discard(state)
                if not unsettled_successors[source]:
                    pending.append(source)
        return settled

    def _merged(
        self, roots: list[int], settled: set[int]
    ) -> tuple[list[int], DecisionDiagrams, list[int]]:
        """Return each state's class, and its diagram into classes, by partition refinement."""
        classes = [int(state in settled) for state in range(len(roots))]
        while True:
            merged, mapped = self._diagrams.relabelled(roots, classes)
            number: dict[tuple[int, int], int] = {}
            finer = [
                number.setdefault((label, root), len(number))
                for label, root in zip(classes, mapped, strict=True)
            ]
            if len(number) == len(set(classes)):
                return classes, merged, mapped
            classes = finer

    def _transitions(
        self, root: int, merged: DecisionDiagrams, number: dict[int, int], satisfied: int | None
    ) -> tuple[Transition, ...]:
        cubes: dict[int, list[Cube]] = {}
        for literals, target in merged.paths(root):
            cubes.setdefault(target, []).append(self._expansion.cube(literals))
        return tuple(
            Transition(simplified(group), number[target], accepting=target == satisfied)
            for target, group in sorted(cubes.items(), key=lambda item: number[item[0]])
        )


def _breadth_first(
    start: int, root_of: dict[int, int], diagrams: DecisionDiagrams, last: int | None
) -> list[int]:
    """Return the classes in the order of a breadth-first search, but one of them last."""
    order = [start]
    for label in order:
        order += [target for target in diagrams.leaves(root_of[label]) if target not in order]
    return sorted(order, key=lambda label: label == last)


def _first_atom(rules: frozenset[tuple[int, int]]) -> int | None:
    """Return the first atom that the rules still read; None if the outcome is certain."""
    if (0, 0) in rules:
        return None
    lowest = min((literals & -literals for literals, _ in rules if literals), default=0)
    return (lowest.bit_length() - 1) // 2 if lowest else None


def _assigned(
    rules: frozenset[tuple[int, int]], atom: int, *, value: bool
) -> frozenset[tuple[int, int]]:
    """Return the (literals, obligations) rules that are left once an atom is known."""
    required, forbidden = 1 << (2 * atom), 2 << (2 * atom)
    violated = forbidden if value else required
    decided = ~(required | forbidden)
    return frozenset((lits & decided, rest) for lits, rest in rules if not lits & violated)
