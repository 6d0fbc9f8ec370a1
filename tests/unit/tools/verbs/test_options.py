"""What the verbs' options refuse."""

import pytest

from support.command import CORRIDOR, refusal

BAD_VALUES = [
    (["plan", CORRIDOR, "--gamma", "0"], "--gamma: expected a number or a ratio from 1e-9 to 1e9"),
    (
        ["plan", CORRIDOR, "--gamma", "1e-99999999"],
        "--gamma: expected a number or a ratio from 1e-9 to 1e9",
    ),
    (
        ["plan", CORRIDOR, "--gamma", "inf"],
        "--gamma: expected a number or a ratio from 1e-9 to 1e9",
    ),
    (["round", CORRIDOR, "--round", "0"], "--round: expected a whole number from 1 on, not '0'"),
    (["round", CORRIDOR, "--round", "x"], "--round: expected a whole number from 1 on, not 'x'"),
    (["simulate", CORRIDOR, "--rounds", "-1"], "--rounds: expected a whole number from 0 on"),
    (["simulate", CORRIDOR, "--rounds", "2.5"], "--rounds: expected a whole number from 0 on"),
    (["simulate", CORRIDOR, "--rounds"], "--rounds: expected one argument"),
    (["simulate", CORRIDOR, "--rounds", "1", "--until", "9"], "not allowed with argument"),
    (["simulate", CORRIDOR, "--until", "0"], "--until: expected a number greater than 0, not '0'"),
    (["simulate", CORRIDOR, "--until", "inf"], "--until: expected a number greater than 0"),
    (["simulate", CORRIDOR, "--until", "nan"], "--until: expected a number greater than 0"),
    (["simulate", CORRIDOR, "--seed", "-3"], "--seed: expected a whole number from 0 to"),
    (
        ["run", CORRIDOR, "--seed", "9223372036854775808"],
        "--seed: expected a whole number from 0 to 9223372036854775807",
    ),
    (["simulate", CORRIDOR, "--pace", "2.0"], "--pace: '2.0' is for 'tlcomm run'"),
    (
        ["simulate", CORRIDOR, "--solver", "nonsense"],
        "(choose from 'best-response', 'coalition', 'exact')",
    ),
    (["simulate", CORRIDOR, "--solver", "nonsense"], "invalid choice: 'nonsense'"),
    (["simulate", CORRIDOR, "--method", "magic"], "'magic' (choose from 'team', 'static'"),
    (["run", CORRIDOR, "--pace", "fast"], "expected 'lockstep' or a factor greater than 0"),
    (["run", CORRIDOR, "--pace", "0"], "(1.0 is real time), not '0'"),
    (["run", CORRIDOR, "--pace", "-1"], "not '-1'"),
    (
        ["bench", CORRIDOR, "--solvers", "--agents", "1"],
        "--agents: expected a whole number from 2 to 1000, not '1'",
    ),
    (["bench", CORRIDOR, "--repeats", "0"], "--repeats: expected a whole number from 1 on"),
]


@pytest.mark.parametrize(("arguments", "complaint"), BAD_VALUES)
def test_a_bad_value_is_one_line(
    arguments: list[str], complaint: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """An option's bad value gives exit status 2 and one line that says what was expected."""
    assert complaint in refusal(capsys, *arguments)
