"""Published sizes of the automata that Spot and LTL3BA make of the literature's formulas.

- ``Size``               states, edges and acceptance marks of one automaton
- ``PublishedSizes``     those of one formula
- ``published_sizes``    those of the three sets

The figures stand in ``published_sizes.csv`` in our own notation: p, q, r, s, t, z for the published
atoms. They were published for the formulas as Spot's ``genltl`` prints them; four of these differ
from ours in ``ltl_benchmarks`` and stand in the table as published. A formula of several sets is
published once.

Source: Major, Blahoudek, Strejček, Sasaráková and Zbončáková, "ltl3tela: LTL to Small Deterministic
or Nondeterministic Emerson-Lei Automata", ATVA 2019; the evaluation's data, ``nondet.patterns.csv``
under ``Experiments/formulae/atva19`` of github.com/jurajmajor/ltl3tela at commit
003aa61d6397c8ae5440e0aadcb2ac159b89f40f: ``ltl2tgba`` of Spot 2.7.4 and ``ltl3ba -H2`` of LTL3BA
1.1.3, both with transition-based generalized Büchi acceptance, counted by Spot's ``ltlcross``.
"""

import csv
from dataclasses import dataclass
from pathlib import Path

__all__ = ["PublishedSizes", "Size", "published_sizes"]

_TABLE = Path(__file__).with_suffix(".csv")


@dataclass(frozen=True, slots=True)
class Size:
    """How large an automaton is.

    Attributes:
        states: its states, without a sink for the words that it rejects.
        edges: one per source, target and marks, whatever its guard.
        marks: acceptance marks; with none, every run accepts.
    """

    states: int
    edges: int
    marks: int


@dataclass(frozen=True, slots=True)
class PublishedSizes:
    """The sizes published for one formula.

    Attributes:
        set_name: the set that it belongs to.
        formula: its text, in our notation.
        spot: Spot's automaton.
        ltl3ba: LTL3BA's.
    """

    set_name: str
    formula: str
    spot: Size
    ltl3ba: Size


def published_sizes() -> tuple[PublishedSizes, ...]:
    """Return the sizes for every formula of the three sets, in the sets' order."""
    with _TABLE.open(encoding="utf-8", newline="") as lines:
        return tuple(
            PublishedSizes(row["set"], row["formula"], _size(row, "spot"), _size(row, "ltl3ba"))
            for row in csv.DictReader(lines)
        )


def _size(row: dict[str, str], tool: str) -> Size:
    return Size(*(int(row[f"{tool}_{figure}"]) for figure in ("states", "edges", "marks")))
