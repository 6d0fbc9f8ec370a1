"""The verb ``plan``."""

import json
from pathlib import Path

import pytest

from support.command import CORRIDOR, run


def test_plan(capsys: pytest.CaptureFixture[str]) -> None:
    """Plans have steps, costs and times; a suffix satisfies; one agent can be asked for."""
    status, out, _ = run(capsys, "plan", CORRIDOR, "--json")
    assert status == 0
    plans = json.loads(out)["agents"]
    assert list(plans) == ["west", "carrier", "east"]
    assert all(any(step["satisfies"] for step in own["suffix"]) for own in plans.values())
    assert all(own["suffix_s"] > 0.0 for own in plans.values())
    assert all(own["suffix_m"] > 0.0 for own in plans.values())
    assert all(len(own["word"]["loop"]) == len(own["suffix"]) for own in plans.values())
    assert run(capsys, "plan", CORRIDOR, "--gamma", "1/3")[0] == 0
    status, out, _ = run(capsys, "plan", CORRIDOR, "--agent", "east")
    assert status == 0
    assert out.startswith("east: G F ((east_bench & inspect)")
    assert "west: " not in out
    assert max(map(len, out.splitlines())) <= 80


def test_a_task_without_a_plan_is_one_line(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """A task that contradicts itself is bad input: exit status 2."""
    text = Path(CORRIDOR).read_text("utf-8")
    task = "G F ((west_shelf & pick) & F (west_bench & place))"
    bad = "F pick & G F place & G !pick"
    (tmp_path / "bad.yaml").write_text(text.replace(task, bad), "utf-8")
    reason = "'F pick' and 'G !pick' contradict each other: no word satisfies them all"
    for verb in ("plan", "validate", "simulate", "run"):
        status, out, err = run(capsys, verb, "bad.yaml")
        assert (status, out) == (2, "")
        assert err == f"tlcomm: error: bad.yaml: agents.west.task: {reason}\n"
    status, out, _ = run(capsys, "ltl", bad)
    assert status == 0
    assert f"conflict      {reason}\n" in out


def test_plan_with_a_soft_task(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """What a plan violates, where and at what price is told; without weight nothing is."""
    text = Path(CORRIDOR).read_text("utf-8")

    def plan(weight: str, *options: str) -> str:
        soft = f"  west:\n    soft: {{task: G !pick, weight_s: {weight}}}\n"
        (tmp_path / "soft.yaml").write_text(text.replace("  west:\n", soft), "utf-8")
        status, out, _ = run(capsys, "plan", "soft.yaml", "--agent", "west", *options)
        assert status == 0
        return out

    out = plan("2.5")
    assert "  soft task G !pick, 2.5 s per atom\n" in out
    assert "1 atom (2.50 s) in each suffix" in out
    assert [line for line in out.splitlines() if "pick" in line and line.endswith("  !pick")]
    own = json.loads(plan("2.5", "--json"))["agents"]["west"]
    assert (own["soft"]["suffix_violation"], own["soft"]["suffix_price_s"]) == (1, 2.5)
    assert ["!pick"] in [step["soft_wants"] for step in own["suffix"]]
    assert "soft task G !pick: ignored, as its weight is 0" in plan("0")
    assert json.loads(plan("0", "--json"))["agents"]["west"]["soft"]["suffix_violation"] is None


def test_plan_explained(capsys: pytest.CaptureFixture[str]) -> None:
    """The second best suffix of the plant's first agent takes 35.35 s instead of 33.89 s."""
    plant = str(Path(CORRIDOR).with_name("plant.yaml"))
    _, out, _ = run(capsys, "plan", plant, "--agent", "agent_1", "--explain")
    assert "\n  why   the second best does without p1 → r1: 35.35 s against 33.89 s\n" in out
    assert max(map(len, out.splitlines())) <= 80
    document = json.loads(run(capsys, "plan", plant, "--explain", "--json")[1])
    explanation = document["agents"]["agent_1"]["explanation"]
    assert explanation["second_best"] == explanation["rivals"][-1]
    assert explanation["second_best"]["without"] == {"from": "p1", "to": "r1", "action": None}
    needed = [rival["without"] for rival in explanation["rivals"] if rival["suffix_s"] is None]
    assert [move["action"] for move in needed] == ["unload", "measure", "collect"]
    plain = json.loads(run(capsys, "plan", plant, "--json")[1])["agents"]["agent_1"]
    assert document["agents"]["agent_1"].keys() - plain.keys() == {"explanation"}
    differs = {key for key, value in plain.items() if value != document["agents"]["agent_1"][key]}
    assert differs <= {"planning_wall_s"}


def test_a_plan_without_a_second_best_says_so(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """To inspect for ever is one move."""
    text = Path(CORRIDOR).read_text("utf-8")
    task = "G F ((west_shelf & pick) & F (west_bench & place))"
    (tmp_path / "one.yaml").write_text(text.replace(task, "F G (west_shelf & pick)"), "utf-8")
    _, out, _ = run(capsys, "plan", "one.yaml", "--agent", "west", "--explain")
    assert "\n  why   it is the only suffix: each of its moves is needed\n" in out
