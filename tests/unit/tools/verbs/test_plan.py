"""The verb ``plan``."""

import json
import re
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
    (tmp_path / "bad.yaml").write_text(text.replace(task, "G F (pick & !pick)"), "utf-8")
    status, _, err = run(capsys, "plan", "bad.yaml")
    assert status == 2
    assert re.fullmatch(
        r"tlcomm: error: bad.yaml: agents.west.task: .* contradicts itself.*\n", err
    )


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
