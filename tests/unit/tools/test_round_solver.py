"""The verb ``round`` with the optimum."""

import json
from pathlib import Path

import pytest

from tlcomm_tools.cli import main

SCENARIOS = Path(__file__).parents[3] / "scenarios"


def test_the_optimum_is_beside_the_equilibrium(capsys: pytest.CaptureFixture[str]) -> None:
    """In the same form under its own name, with a proof, and no worse."""
    arguments = ["round", str(SCENARIOS / "corridor.yaml"), "--round", "2", "--solver", "exact"]
    assert main([*arguments, "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    exact = document["exact"]
    assert exact.keys() == {*document["nash"], "bound"}
    assert exact["bound"] <= exact["potential"] <= document["nash"]["potential"]
    assert exact["potential"] - exact["bound"] <= 1e-6
    assert main(arguments) == 0
    assert f"Φ = {exact['potential']:.3f} s by exact" in capsys.readouterr().out


def test_too_many_agents_are_refused(capsys: pytest.CaptureFixture[str]) -> None:
    """One line says how many there are, and how many may be."""
    path = SCENARIOS / "warehouse.yaml"
    assert main(["round", str(path), "--round", "1", "--solver", "exact"]) == 2
    assert "20 agents" in capsys.readouterr().err


def test_a_round_is_explained(capsys: pytest.CaptureFixture[str]) -> None:
    """What agents pay adds up to the potential; the text says the same as the document."""
    arguments = ["round", str(SCENARIOS / "corridor.yaml"), "--round", "2", "--explain"]
    assert main([*arguments, "--json"]) == 0
    document = json.loads(capsys.readouterr().out)
    explanation = document["explanation"]
    paid_s = sum(own["additional_s"] for own in explanation["agents"])
    assert paid_s == pytest.approx(explanation["potentials"][-1])
    assert explanation["potentials"] == sorted(explanation["potentials"], reverse=True)
    assert main(arguments) == 0
    out = capsys.readouterr().out
    assert f"Φ(S⁰) = {explanation['potentials'][0]:.3f} s" in out
    assert "nobody gains by moving alone" in out
    assert max(map(len, out.splitlines())) <= 100
