"""Decision diagrams: sharing, values, paths."""

from tlcomm_core.ltl.decision_diagram import DecisionDiagrams


def test_equal_functions_have_equal_indices() -> None:
    """A function is the same index however it is built, and a needless test disappears."""
    table = DecisionDiagrams()
    zero, one = table.leaf(0), table.leaf(1)
    assert table.leaf(0) == zero
    assert table.branch(0, one, one) == one
    inner = table.branch(1, zero, one)
    assert table.branch(0, zero, inner) == table.branch(0, zero, table.branch(1, zero, one))
    assert table.branch(0, zero, inner) != table.branch(0, inner, zero)


def test_paths_cover_every_letter_once() -> None:
    """The paths of "both" are not-a, a and not-b, a and b."""
    table = DecisionDiagrams()
    both = table.branch(0, table.leaf(7), table.branch(1, table.leaf(7), table.leaf(9)))
    assert list(table.paths(both)) == [(0b10, 7), (0b1001, 7), (0b0101, 9)]
    assert list(table.leaves(both)) == [7, 9]


def test_relabelling_merges_what_becomes_equal() -> None:
    """A function whose values become equal becomes a leaf of the new table."""
    table = DecisionDiagrams()
    root = table.branch(0, table.leaf(0), table.leaf(1))
    merged, (fresh,) = table.relabelled([root], [5, 5])
    assert list(merged.paths(fresh)) == [(0, 5)]
