"""The verb ``network``."""

import json

import pytest

from support.command import refusal, run

QUICK = ("network", "--agents", "2", "3", "--meetings", "4")


def test_network(capsys: pytest.CaptureFixture[str]) -> None:
    """The table has a row per team and fits 80 columns; JSON has the same figures."""
    status, out, _ = run(capsys, *QUICK)
    assert status == 0
    assert "30% lost, 20% doubled, 50 ms jitter; D_c = 5 s" in out
    assert [line.split()[0] for line in out.splitlines()[-2:]] == ["2", "3"]
    assert max(map(len, out.splitlines())) <= 80
    _, out, _ = run(capsys, *QUICK, "--json")
    teams = json.loads(out)["teams"]
    assert [team["agents"] for team in teams] == [2, 3]
    for team in teams:
        assert team["late"] == 0
        assert 0.0 < team["median_s"] <= team["p95_s"] <= team["longest_s"] < 5.0


def test_what_is_late_has_no_time(capsys: pytest.CaptureFixture[str]) -> None:
    """Meetings without agreement are counted; a dash stands for times that include them."""
    _, out, _ = run(capsys, *QUICK, "--loss", "1")
    assert out.splitlines()[-1].split()[:5] == ["3", "4", "–", "–", "–"]


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["--loss", "1.1"], "--loss: expected a number from 0 to 1, not '1.1'"),
        (["--jitter", "-1"], "--jitter: expected a number from 0 on, not '-1'"),
        (["--duration", "0"], "--duration: expected a number greater than 0, not '0'"),
        (["--agents", "1"], "--agents: expected a whole number from 2 to 30, not '1'"),
        (["--agents", "8", "31"], "--agents: expected a whole number from 2 to 30, not '31'"),
        (["--agents", "two"], "--agents: expected a whole number from 2 to 30, not 'two'"),
        (["--jitter", "5"], "--duration: 5.0 isn't longer than a message may take (5.005 s"),
    ],
)
def test_bad_conditions_are_refused(
    arguments: list[str], complaint: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """One line says what is expected."""
    assert complaint in refusal(capsys, "network", *arguments)
