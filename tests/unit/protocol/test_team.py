"""The team's common ground."""

from dataclasses import replace

from support.meetings import make_team


def test_windows_follow_each_other() -> None:
    """Round r's window is [r·T_c, (r+1)·T_c)."""
    team = make_team(2)
    assert team.opens_s(0) == 0.0
    assert team.window_s(3) == (180.0, 240.0)
    assert team.window_s(3)[1] == team.opens_s(4)


def test_a_round_is_planned_at_the_meeting_before() -> None:
    """In the window before, or a stride before; the first ones at t = 0. It may be confirmed until
    D_c after that window.
    """
    team = make_team(2)
    assert [team.planned_in(round_) for round_ in (1, 2, 3)] == [0, 1, 2]
    assert [team.confirmable_until_s(round_) for round_ in (1, 2)] == [65.0, 125.0]
    pair = replace(team, stride=3)
    assert [pair.planned_in(round_) for round_ in (1, 3, 4, 7)] == [0, 0, 1, 4]
    assert [pair.confirmable_until_s(round_) for round_ in (1, 3, 4)] == [65.0, 65.0, 125.0]
