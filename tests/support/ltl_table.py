"""The table of docs/ltl.md: states, edges and times beside spin's states.

Run ``PYTHONPATH=tests:ros2_ws/src/tlcomm_core python -m support.ltl_table``.
"""

from statistics import mean, median
from sys import stdout
from time import process_time

from support.ltl_benchmarks import DWYER, ETESSAMI_HOLZMANN, SOMENZI_BLOEM, without_next
from support.spin import spin_state_count
from tlcomm_core.ltl import BuchiAutomaton, Formula, parse, tableau_automaton

__all__ = ["row"]

SETS = {
    "Dwyer": DWYER,
    "Etessami–Holzmann": ETESSAMI_HOLZMANN,
    "Somenzi–Bloem": SOMENZI_BLOEM,
    "random": without_next(200),
}


def timed(formula: Formula) -> tuple[BuchiAutomaton, float]:
    """Return the automaton and the best processor time of three, in milliseconds."""
    best = float("inf")
    for _ in range(3):
        begun = process_time()
        automaton = tableau_automaton(formula)
        best = min(best, process_time() - begun)
    return automaton, 1e3 * best


def with_acceptance_on_states(automaton: BuchiAutomaton) -> int:
    """Return how many states are needed if a state says whether the edge into it accepts."""
    seen = {(automaton.initial, False)}
    pending = list(seen)
    for state, _ in pending:
        for edge in automaton.transitions[state]:
            node = (edge.target, edge.accepting)
            if node not in seen:
                seen.add(node)
                pending.append(node)
    return len(seen)


def row(name: str, texts: tuple[str, ...]) -> str:
    """Return one line of the table."""
    states, edges, times = [], [], []
    ratios, state_ratios = [], []
    for text in texts:
        formula = parse(text)
        automaton, time_ms = timed(formula)
        states.append(automaton.state_count)
        edges.append(sum(map(len, automaton.transitions)))
        times.append(time_ms)
        spins = spin_state_count(formula, limit_s=1.0)
        if spins:
            ratios.append(automaton.state_count / spins)
            state_ratios.append(with_acceptance_on_states(automaton) / spins)
    return (
        f"| {name} | {len(texts)} | {mean(states):.2f} | {mean(edges):.2f} | {max(states)}"
        f" | {median(times):.1f} | {max(times):.0f} | {len(ratios)} | {mean(ratios):.2f}"
        f" | {max(ratios):.2f} | {mean(state_ratios):.2f} |"
    )


if __name__ == "__main__":
    for set_name, formulas in SETS.items():
        stdout.write(row(set_name, formulas) + "\n")
