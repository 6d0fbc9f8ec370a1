"""Whether an automaton accepts a word that repeats for ever.

- ``accepts``   on stem·loop^ω
"""

from tlcomm_core.ltl import BuchiAutomaton
from tlcomm_core.ltl.automaton import strong_components

__all__ = ["accepts"]

Word = tuple[frozenset[str], ...]


def accepts(automaton: BuchiAutomaton, stem: Word, loop: Word) -> bool:
    """Return whether an accepting edge lies on a cycle of the product with stem·loop^ω."""
    word = [*stem, *loop]
    number = {(automaton.initial, 0): 0}
    pending = [(automaton.initial, 0)]
    rows: list[list[tuple[int, bool]]] = []
    for state, place in pending:
        after = place + 1 if place + 1 < len(word) else len(stem)
        rows.append([])
        for target, accepting in automaton.successors(state, word[place]):
            node = (target, after)
            if node not in number:
                number[node] = len(number)
                pending.append(node)
            rows[-1].append((number[node], accepting))
    component = strong_components([[target for target, _ in row] for row in rows])
    return any(
        accepting and component[node] == component[target]
        for node, row in enumerate(rows)
        for target, accepting in row
    )
