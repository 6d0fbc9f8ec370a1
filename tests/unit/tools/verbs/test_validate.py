"""The verb ``validate``."""

import json

import pytest

from support.command import CORRIDOR, run


def test_validate(capsys: pytest.CaptureFixture[str]) -> None:
    """A good scenario is told to be ok, by text and by JSON."""
    status, out, _ = run(capsys, "validate", CORRIDOR)
    assert (status, out.splitlines()[0]) == (0, f"{CORRIDOR}: ok")
    status, out, _ = run(capsys, "validate", CORRIDOR, "--json")
    assert (status, json.loads(out)["agents"]) == (0, ["west", "carrier", "east"])
