"""The second table of docs/ltl.md: our states and edges beside Spot's and LTL3BA's.

Run ``PYTHONPATH=tests:ros2_ws/src/tlcomm_core python -m support.ltl_size_table``; with ``--each``
it lists the formulas of which we make more states than Spot.

- ``Compared``   one formula's sizes
- ``compared``   those of all formulas
"""

from dataclasses import dataclass
from itertools import groupby
from sys import argv, stdout

from support.published_sizes import PublishedSizes, Size, published_sizes
from tlcomm_core.ltl import parse, translate

__all__ = ["Compared", "compared"]


@dataclass(frozen=True, slots=True)
class Compared:
    """What was published for a formula, and the automaton that planning uses for it."""

    published: PublishedSizes
    ours: Size


def compared() -> list[Compared]:
    """Translate every formula for which sizes are published."""
    return [Compared(sizes, _our_size(sizes.formula)) for sizes in published_sizes()]


def _our_size(text: str) -> Size:
    """Return an automaton's size; its edges are already one per source, target and acceptance."""
    automaton = translate(parse(text))
    return Size(automaton.state_count, sum(map(len, automaton.transitions)), marks=1)


def _line(name: str, rows: list[Compared]) -> str:
    """Return one line of the table."""
    tools = (
        [row.ours for row in rows],
        [row.published.spot for row in rows],
        [row.published.ltl3ba for row in rows],
    )
    ratios = [row.ours.states / row.published.spot.states for row in rows]
    larger = sum(ratio > 1 for ratio in ratios)
    states = [sum(size.states for size in sizes) for sizes in tools]
    edges = [sum(size.edges for size in sizes) for sizes in tools]
    cells = [
        *(f"{total} ({total / len(rows):.2f})" for total in (*states, *edges)),
        f"{states[0] / states[1]:.2f}",
        f"{states[0] / states[2]:.2f}",
        str(larger),
    ]
    return f"| {name} | {len(rows)} | {' | '.join(cells)} |\n"


def _formula_line(row: Compared) -> str:
    sizes = (row.ours, row.published.spot, row.published.ltl3ba)
    figures = "  ".join(f"{size.states:>3},{size.edges:>3}" for size in sizes)
    return f"{figures}  {row.published.formula}\n"


if __name__ == "__main__":
    found = compared()
    for set_name, members in groupby(found, lambda row: row.published.set_name):
        stdout.write(_line(set_name, list(members)))
    stdout.write(_line("all", found))
    if "--each" in argv:
        larger_ones = [row for row in found if row.ours.states > row.published.spot.states]
        stdout.writelines(map(_formula_line, larger_ones))
