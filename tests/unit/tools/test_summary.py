"""Tests of ``tlcomm_tools.summary`` and ``table``."""

from pathlib import Path

from support.hand_made_run import END_S, hand_made_records, hand_made_scenario
from tlcomm_core.method import Method
from tlcomm_core.result import RunFacts, result_document
from tlcomm_tools.folder import RunFolder
from tlcomm_tools.summary import format_summary
from tlcomm_tools.table import format_number, format_table

FACTS = RunFacts(Method.TEAM, "best-response", 3, 1.0, END_S, 12.5)


def test_a_summary_says_what_matters() -> None:
    """Verdict, windows, times, agents, rounds, files and the command to check are there."""
    result = result_document(hand_made_scenario(), hand_made_records(), FACTS)
    text = format_summary(result, RunFolder(Path("runs/x")), has_bag=True)
    assert text.splitlines() == [
        "line, method team, solver best-response, seed 3, pace 1.0",
        "verdict: ok",
        "",
        "  windows kept     3 of 3",
        "  simulated        25.0 s in 12.5 s, 2.0 × real time",
        "  makespans        20.0 s together",
        "  additional time  3.0 s per meeting: detour 0.5 s, wait 2.5 s; 5.0 s with D_c",
        "  lost time        9.0 s of each window",
        "  information age  1.4 s on average, at most 6.0 s",
        "  own computing    median 20.0 ms, at most 20.0 ms per round",
        "  coordination     median 250.0 ms, at most 250.0 ms per round",
        "  not heard        lost 2, out of range 5",
        "",
        "  agent  tasks  makespan/s  distance/m  messages  bytes",
        "  east       2        10.0        10.0         3    204",
        "  west       2        10.0         8.0         2    136",
        "",
        "  round  t_c/s  Φ(S⁰)/s  Φ/s  moves  additional/s  worst agent/s",
        "      1   10.0      7.0  6.0      1           6.0            3.5",
        "      2   20.0      7.0  6.0      1           6.0            3.5",
        "",
        "files   runs/x",
        "check   scripts/tlcomm check runs/x",
    ]


def test_what_a_run_does_not_have_is_left_out() -> None:
    """A run without meetings has no additional time, one with a field has a deviation."""
    result = result_document(hand_made_scenario(), hand_made_records(), FACTS)
    result["metrics"]["team"] |= {
        "additional_s": None,
        "deviation_mean": 0.1234,
        "deviation_max": 1.0201,
        "deviation_settled_max": 0.8201,
    }
    text = format_summary(result, RunFolder(Path("runs/x")), has_bag=False)
    assert "additional time" not in text
    assert "  lost time        9.0 s of each window\n" in text
    assert "  deviation        0.123 on average, at most 1.020, 0.820 once settled\n" in text


def test_long_runs_and_long_verdicts_are_cut() -> None:
    """Only the last rounds and the first failures are shown, and how many are not."""
    result = result_document(hand_made_scenario(), hand_made_records(), FACTS)
    result["rounds"] = [{**result["rounds"][0], "round": number} for number in range(1, 101)]
    result["verdict"] = [f"failure {number}" for number in range(50)]
    text = format_summary(result, RunFolder(Path("runs/x")), has_bag=False)
    assert "  … 88 rounds before" in text
    assert "  - failure 19\n  … and 30 more" in text
    assert "check" not in text


def test_what_is_missing_is_a_dash() -> None:
    """Figures that aren't available are dashes, never zeros."""
    assert format_number(None, 2, "s") == "–"
    assert format_number(0.125, 2, "s") == "0.12 s"
    assert format_number(7, 0) == "7"


def test_tables_are_aligned() -> None:
    """The first columns are aligned to the left, the others to the right."""
    table = format_table(("a", "bb"), [("long", "1"), ("x", "200")], indent="")
    assert table.splitlines() == ["a      bb", "long    1", "x     200"]


def test_who_met_is_told_where_not_all_do() -> None:
    """As in meetings of pairs."""
    result = result_document(hand_made_scenario(), hand_made_records(), FACTS)
    first, second = result["rounds"]
    result["rounds"] = [first, second | {"members": ["east", "north"]}]
    text = format_summary(result, RunFolder(Path("runs/x")), has_bag=False)
    assert "      1   10.0      7.0  6.0      1           6.0            3.5   east west\n" in text
    assert "      2   20.0      7.0  6.0      1           6.0            3.5  east north\n" in text
