"""What a team knows beforehand that takes turns."""

import math

from tlcomm_core.protocol.turns import TurnTeam, pause_s


def team_of(count: int) -> TurnTeam:
    """Return a team of so many."""
    return TurnTeam(frozenset(f"agent_{k}" for k in range(count)), 0.96, 60.0, 0.25)


def test_a_turn_may_be_at_any_time() -> None:
    """Its window is always open, and nobody has to give it up."""
    team = team_of(2)
    assert team.window_s(7) == (0.0, math.inf)
    assert team.opens_s(7) == 0.0
    assert team.confirmable_until_s(7) == math.inf
    assert team.horizon_s(7, 1000.0) == 60.0


def test_a_good_radio_needs_a_short_pause_and_a_bad_one_a_longer() -> None:
    """With every loss, latency and member, and even if nothing gets through it is finite."""
    good_s = pause_s(team_of(8), 0.005)
    assert 0.2 < good_s < 0.3
    assert good_s < pause_s(team_of(8), 0.02) < pause_s(team_of(8), 0.02, 0.01)
    losses_s = [pause_s(team_of(8), 0.005, loss=loss) for loss in (0.0, 0.01, 0.3, 0.7, 1.0)]
    assert losses_s == sorted(set(losses_s))
    assert math.isfinite(losses_s[-1])
    assert pause_s(team_of(2), 0.005, loss=0.3) < pause_s(team_of(20), 0.005, loss=0.3)
