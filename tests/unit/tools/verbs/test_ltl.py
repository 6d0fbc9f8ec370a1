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
