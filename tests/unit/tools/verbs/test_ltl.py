"""The verb ``ltl``."""

import json

import pytest

from support.command import run


def test_ltl(capsys: pytest.CaptureFixture[str]) -> None:
    """A formula's automaton comes in HOA, as a drawing, as text and as JSON."""
    assert run(capsys, "ltl", "G F a", "--hoa")[1].startswith("HOA: v1")
    assert run(capsys, "ltl", "G F a", "--dot")[1].startswith("digraph")
    assert "restarted good-prefix automaton" in run(capsys, "ltl", "G F a")[1]
    document = json.loads(run(capsys, "ltl", "F G a", "--json")[1])
    assert document["construction"] == "tableau"
    assert document["hoa"].startswith("HOA: v1")


def test_ltl_explained(capsys: pytest.CaptureFixture[str]) -> None:
    """Class, determinism and three words, as text and as JSON."""
    status, out, _ = run(capsys, "ltl", "a & X b", "--explain")
    assert status == 0
    assert "class         safety and co-safety" in out
    assert "satisfied by  (a & b) for ever\nviolated by   (–) for ever\n" in out
    assert "not yet       a … (presumably false)\n" in out
    document = json.loads(run(capsys, "ltl", "F a & G !a", "--explain", "--json")[1])
    assert document["conflict"] == ["F a", "G !a"]
    assert document["explanation"] == {
        "satisfiability": "unsatisfiable",
        "class": "other",
        "deterministic": True,
        "satisfied": None,
        "violated": {"stem": [], "loop": [[]]},
        "not_yet": None,
    }
