"""Formulas on which the literature compares translations of LTL.

- ``DWYER``              the 55 specification patterns
- ``ETESSAMI_HOLZMANN``  12 formulas
- ``SOMENZI_BLOEM``      27 formulas
- ``random_formula``     a formula with a bounded depth
- ``without_next``       random formulas for tools that lack X
"""

from collections.abc import Sequence
from random import Random
from typing import Final

__all__ = ["DWYER", "ETESSAMI_HOLZMANN", "SOMENZI_BLOEM", "random_formula", "without_next"]

_TWICE: Final = (
    "((!p & !r) U (r | ((p & !r) U (r | ((!p & !r) U (r | ((p & !r) U (r | {last}))))))))"
)
_TWICE_GLOBALLY: Final = "(!p W (p W (!p W (p W G !p))))"

# Source: Dwyer, Avrunin and Corbett, "Property specification patterns for finite-state
# verification", 1998, as in the authors' LTL catalogue: eleven patterns, each globally, before r,
# after q, between q and r, after q until r.
DWYER: Final = (
    # absence
    "G !p",
    "F r -> (!p U r)",
    "G (q -> G !p)",
    "G ((q & !r & F r) -> (!p U r))",
    "G (q & !r -> (!p W r))",
    # existence
    "F p",
    "!r W (p & !r)",
    "G !q | F (q & F p)",
    "G (q & !r -> (!r W (p & !r)))",
    "G (q & !r -> (!r U (p & !r)))",
    # at most two times
    _TWICE_GLOBALLY,
    "F r -> " + _TWICE.format(last="(!p U r)"),
    f"F q -> (!q U (q & {_TWICE_GLOBALLY}))",
    "G ((q & F r) -> " + _TWICE.format(last="(!p U r)") + ")",
    "G (q -> " + _TWICE.format(last="(!p W r) | G p") + ")",
    # universality
    "G p",
    "F r -> (p U r)",
    "G (q -> G p)",
    "G ((q & !r & F r) -> (p U r))",
    "G (q & !r -> (p W r))",
    # precedence
    "!p W s",
    "F r -> (!p U (s | r))",
    "G !q | F (q & (!p W s))",
    "G ((q & !r & F r) -> (!p U (s | r)))",
    "G (q & !r -> (!p W (s | r)))",
    # response
    "G (p -> F s)",
    "F r -> ((p -> (!r U (s & !r))) U r)",
    "G (q -> G (p -> F s))",
    "G ((q & !r & F r) -> ((p -> (!r U (s & !r))) U r))",
    "G (q & !r -> ((p -> (!r U (s & !r))) W r))",
    # s, t precede p
    "F p -> (!p U (s & !p & X (!p U t)))",
    "F r -> (!p U (r | (s & !p & X (!p U t))))",
    "G !q | (!q U (q & (F p -> (!p U (s & !p & X (!p U t))))))",
    "G ((q & F r) -> (!p U (r | (s & !p & X (!p U t)))))",
    "G (q -> (F p -> (!p U (r | (s & !p & X (!p U t))))))",
    # p precedes s, t
    "F (s & X F t) -> (!s U p)",
    "F r -> (!(s & !r & X (!r U (t & !r))) U (r | p))",
    "G !q | (!q U (q & (F (s & X F t) -> (!s U p))))",
    "G ((q & F r) -> (!(s & !r & X (!r U (t & !r))) U (r | p)))",
    "G (q -> ((!(s & !r & X (!r U (t & !r))) U (r | p)) | G !(s & X F t)))",
    # p responds to s, t
    "G (s & X F t -> X F (t & F p))",
    "F r -> ((s & X (!r U t) -> X (!r U (t & F p))) U r)",
    "G (q -> G (s & X F t -> X (!t U (t & F p))))",
    "G ((q & F r) -> ((s & X (!r U t) -> X (!r U (t & F p))) U r))",
    (
        "G (q -> ((s & X (!r U t) -> X (!r U (t & F p))) U"
        " (r | G (s & X (!r U t) -> X (!r U (t & F p))))))"
    ),
    # s, t respond to p
    "G (p -> F (s & X F t))",
    "F r -> ((p -> (!r U (s & !r & X (!r U t)))) U r)",
    "G (q -> G (p -> (s & X F t)))",
    "G ((q & F r) -> ((p -> (!r U (s & !r & X (!r U t)))) U r))",
    "G (q -> ((p -> (!r U (s & !r & X (!r U t)))) U (r | G (p -> (s & X F t)))))",
    # s, t without z respond to p
    "G (p -> F (s & !z & X (!z U t)))",
    "F r -> ((p -> (!r U (s & !r & !z & X ((!r & !z) U t)))) U r)",
    "G (q -> G (p -> (s & !z & X (!z U t))))",
    "G ((q & F r) -> ((p -> (!r U (s & !r & !z & X ((!r & !z) U t)))) U r))",
    (
        "G (q -> ((p -> (!r U (s & !r & !z & X ((!r & !z) U t)))) U"
        " (r | G (p -> (s & !z & X (!z U t))))))"
    ),
)

# Source: Etessami and Holzmann, "Optimizing Büchi automata", 2000.
ETESSAMI_HOLZMANN: Final = (
    "p U (q & G r)",
    "p U (q & X (r U s))",
    "p U (q & X (r & F (s & X F (t & X F (u & X F v)))))",
    "F (p & X G q)",
    "F (p & X (q & X F r))",
    "F (q & X (p U r))",
    "F G q | G F p",
    "G (p -> q U r)",
    "G (p & X F (q & X F (r & X F s)))",
    "G F p & G F q & G F r & G F s & G F t",
    "p U (q U r) | q U (r U p) | r U (p U q)",
    "G (p -> q U (G r | G s))",
)

# Source: Somenzi and Bloem, "Efficient Büchi automata from LTL formulae", 2000.
SOMENZI_BLOEM: Final = (
    "p U q",
    "p U (q U r)",
    "!(p U (q U r))",
    "G F p -> G F q",
    "(F p) U (G q)",
    "(G p) U q",
    "!(F F p <-> F p)",
    "!(G F p -> G F q)",
    "!(G F p <-> G F q)",
    "p R (p | q)",
    "(X p U X q) | !X (p U q)",
    "(X p U q) | !X (p U (p & q))",
    "G (p -> F q) & ((X p U q) | !X (p U (p & q)))",
    "G (p -> F q) & ((X p U X q) | !X (p U q))",
    "G (p -> F q)",
    "!G (p -> X (q R r))",
    "!(G F p | F G q)",
    "G (F p & F q)",
    "F p & F !p",
    "(X q & r) R X (((s U p) R r) U (s R r))",
    "(G (q | G F p) & G (r | G F !p)) | G q | G r",
    "(G (q | F G p) & G (r | F G !p)) | G q | G r",
    "!((G (q | G F p) & G (r | G F !p)) | G q | G r)",
    "!((G (q | F G p) & G (r | F G !p)) | G q | G r)",
    "(G (q | X G p) & G (r | X G !p)) | G q | G r",
    "G (q | (X p & X !p))",
    "(p U p) | (q U p)",
)

_UNARY: Final = ("!", "X ", "F ", "G ")
_BINARY: Final = ("&", "|", "->", "<->", "U", "R", "W", "M")


def random_formula(
    rng: Random, depth: int, names: str = "abcd", unary: Sequence[str] = _UNARY
) -> str:
    """Return the text of a formula with at most ``depth`` operators on a path."""
    if depth == 0 or rng.random() < 0.15:
        return rng.choice(names)
    if rng.random() < 0.4:
        return f"{rng.choice(unary)}({random_formula(rng, depth - 1, names, unary)})"
    left, right = (random_formula(rng, depth - 1, names, unary) for _ in range(2))
    return f"({left}) {rng.choice(_BINARY)} ({right})"


def without_next(count: int) -> tuple[str, ...]:
    """Return different random formulas of depth 3 over three atoms, for tools without X."""
    rng = Random(3)  # noqa: S311  nothing secret
    found: dict[str, None] = {}
    while len(found) < count:
        found[random_formula(rng, 3, "abc", ("!", "F ", "G "))] = None
    return tuple(found)
