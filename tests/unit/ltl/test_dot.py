"""The Graphviz drawing."""

from tlcomm_core.ltl import parse, to_dot, translate


def test_drawing_has_every_state_and_edge() -> None:
    """States, guards and acceptance appear; quotes are escaped."""
    assert to_dot(translate(parse("a U b")), 'say "hi"') == (
        'digraph "say \\"hi\\"" {\n'
        "  rankdir=LR\n"
        "  node [shape=circle]\n"
        '  start [shape=point, label=""]\n'
        "  start -> 0\n"
        "  0\n"
        "  1\n"
        '  0 -> 0 [label="a"]\n'
        '  0 -> 1 [label="b"]\n'
        '  1 -> 1 [label="true", style=bold, color=firebrick]\n'
        "}\n"
    )
