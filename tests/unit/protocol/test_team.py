"""The team's common ground."""

from support.meetings import make_team


def test_windows_follow_each_other() -> None:
    """Round r's window is [r·T_c, (r+1)·T_c)."""
    team = make_team(2)
    assert team.opens_s(0) == 0.0
    assert team.window_s(3) == (180.0, 240.0)
    assert team.window_s(3)[1] == team.opens_s(4)
