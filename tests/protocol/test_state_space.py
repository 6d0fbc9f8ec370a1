"""Every state of small teams, and that the search finds what is broken on purpose."""

from collections.abc import Callable

import pytest

from support.state_space import Space, flaw, tiny_space
from tlcomm_core.game.solver import EXACT
from tlcomm_core.protocol.confirming import Confirming
from tlcomm_core.protocol.consensus import MinimumConsensus
from tlcomm_core.protocol.improving import Improving
from tlcomm_core.protocol.whereabouts import Ending, Whereabouts

# Far more than any space here has.
MOST = 2_000_000


@pytest.mark.parametrize(
    ("space", "least"),
    [
        (lambda: tiny_space("line", 2), 1000),
        (lambda: tiny_space("line", 2, iterations=2), 1300),
        (lambda: tiny_space("line", 2, solver=EXACT), 1300),
        (lambda: tiny_space("line", 3, is_gathered=True), 4500),
        (lambda: tiny_space("line", 3, is_gathered=True, is_prompt=True, solver=EXACT), 500),
        (lambda: tiny_space("clique", 3, is_gathered=True, is_prompt=True), 14_000),
        (lambda: tiny_space("line", 4, is_gathered=True, is_prompt=True), 30_000),
    ],
    ids=["2", "2 twice", "2 proposing", "3 in line", "3 proposing", "3 all near", "4 in line"],
)
def test_no_state_is_unsafe_or_dead(space: Callable[[], Space], least: int) -> None:
    """In no order of deliveries, losses and repetitions is anything agreed that not all have
    confirmed, or is the team scattered for two windows if it must leave; and from every state
    agreement is reached once nothing is lost.
    """
    found = space().explore(flaw, MOST)
    assert found.flaws == ()
    assert found.is_complete
    assert found.team_states >= least


def test_agreeing_without_everybody_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """One confirmation less than the team has members isn't enough."""

    def is_nearly_complete(self: Confirming) -> bool:
        return len(self._flood.known) >= len(self._members) - 1

    monkeypatch.setattr(Confirming, "is_complete", property(is_nearly_complete))
    (wrong,) = tiny_space("line", 3, is_gathered=True).explore(flaw, MOST).flaws
    assert wrong.startswith("somebody has agreed though not all have confirmed the same: agent_")


def test_confirming_two_strategies_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """An exchange that doesn't wait for all neighbours ends differently for each."""
    monkeypatch.setattr(MinimumConsensus, "_is_step_complete", lambda _self: True)
    (wrong,) = tiny_space("line", 2, iterations=2).explore(flaw, MOST).flaws
    assert wrong.startswith("two strategies are confirmed: agent_")


def test_breaking_a_promise_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """Who has confirmed and stays at the old place in doubt misses those who agreed, for good."""
    after = Whereabouts.after

    def stay(
        self: Whereabouts, window: int, ending: Ending, new: tuple[float, float] | None
    ) -> Whereabouts:
        is_doubtful = ending is Ending.DOUBTFUL
        return after(self, window, Ending.GATHERED if is_doubtful else ending, new)

    monkeypatch.setattr(Whereabouts, "after", stay)
    (wrong,) = tiny_space("line", 2).explore(flaw, MOST).flaws
    assert wrong.startswith("the team is scattered for two windows: agent_")


def test_repeating_too_little_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """A neighbour one exchange behind needs the last message but one."""
    monkeypatch.setattr(
        Improving, "unsuperseded", property(lambda self: self._consensus.unsuperseded[-1:])
    )
    flaws = tiny_space("line", 2, iterations=2).explore(flaw, MOST).flaws
    assert flaws
    assert all(wrong.startswith("no agreement within") for wrong in flaws)
