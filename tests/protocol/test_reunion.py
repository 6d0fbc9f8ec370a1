"""Teams that come together again though a meeting ended without agreement, brains and all."""

from collections.abc import Callable

import numpy as np
import pytest

from support.hall import DURATION_S, PERIOD_S
from support.troop import Troop
from tlcomm_core.agent.actions import TaskEvent, TaskEventKind
from tlcomm_core.protocol.messages import BestResponse, Confirmation, Message

REACHED, BEGUN = TaskEventKind.MEETING_REACHED, TaskEventKind.MEETING_STARTED
ENDED, FAULT = TaskEventKind.MEETING_ENDED, TaskEventKind.FAULT
NAMES = ("one", "two", "three")
Cut = Callable[[float, str, Message], bool]


def troop_of(is_cut: Cut, until_s: float) -> Troop:
    """Return three agents after a time on such a network."""
    troop = Troop(NAMES, is_cut)
    troop.run(until_s)
    return troop


def starts(troop: Troop) -> dict[str, list[int]]:
    """Return the rounds whose meetings started, by agent."""
    events = troop.events(BEGUN)
    return {name: [event.round for _, event in own] for name, own in events.items()}


def details(troop: Troop, name: str) -> list[str]:
    """Return what an agent said of meetings without agreement, in order."""
    faults: list[tuple[float, TaskEvent]] = troop.events(FAULT)[name]
    assert all(event.is_disagreement and event.is_coped_with for _, event in faults)
    return [event.detail for _, event in faults]


def is_confirmation_to_one(time_s: float, receiver: str, message: Message) -> bool:
    """Cut what would complete the first agent's confirmations of round 1."""
    del time_s
    return receiver == "one" and message.round == 1 and isinstance(message, Confirmation)


def test_who_lacks_the_last_confirmations_is_at_the_next_meeting() -> None:
    """It goes by what it has confirmed, as late as it can be there when the meeting begins; all
    meet in the next window as agreed, and in all later ones.
    """
    troop = troop_of(is_confirmation_to_one, 6 * PERIOD_S)
    assert details(troop, "one") == ["agreement=late round=1", "agreement=doubtful round=1"]
    assert details(troop, "two") == details(troop, "three") == []
    assert starts(troop) == {name: list(range(6)) for name in NAMES}
    agreed_s = troop.agents["two"].held[0].strategy.communication_s
    assert [t for t, e in troop.events(REACHED)["one"] if e.round == 1] == [
        pytest.approx(agreed_s, abs=1e-6)
    ]


def test_whose_neighbour_lacks_a_word_lingers_a_little() -> None:
    """Who can see that its neighbours need nothing leaves when the meeting is over."""
    troop = troop_of(is_confirmation_to_one, PERIOD_S)
    linger_s = troop.agents["two"].brain._settings.team.linger_s
    ended_s = {name: [t for t, _ in own] for name, own in troop.events(ENDED).items()}
    assert ended_s["two"] == [DURATION_S + linger_s]
    assert ended_s["three"] == [DURATION_S]
    assert ended_s["one"] == []


def test_late_confirmations_end_the_doubt() -> None:
    """An agent that still gets them leaves with the others that lingered, and is late for nothing
    that it can make up for.
    """
    until_s = DURATION_S + 0.2
    troop = troop_of(lambda t, r, m: is_confirmation_to_one(t, r, m) and t < until_s, 90.0)
    assert details(troop, "one") == ["agreement=late round=1"]
    ended_s = [own[0][0] for own in troop.events(ENDED).values()]
    assert all(DURATION_S <= time_s <= until_s + 0.2 for time_s in ended_s)
    assert starts(troop) == {name: [0, 1, 2] for name in NAMES}


def test_a_team_that_was_split_meets_again_at_the_last_places() -> None:
    """One has confirmed and goes to the new place; the others never could, and stay. It comes
    back in the window after.
    """
    troop = troop_of(
        lambda _t, r, m: (
            r == "three" and m.round == 1 and isinstance(m, BestResponse) and m.iteration > 0
        ),
        6 * PERIOD_S,
    )
    assert details(troop, "one") == [
        "agreement=late round=1",
        "agreement=doubtful round=1",
        "agreement=missed round=2",
    ]
    assert details(troop, "two")[1:] == ["agreement=gathered round=1", "agreement=missed round=2"]
    assert starts(troop) == {name: [0, 2, 3, 4, 5] for name in NAMES}
    # The second meeting is where the first was.
    (again_s,) = (t for t, e in troop.events(BEGUN)["two"] if e.round == 2)
    assert 2 * PERIOD_S + DURATION_S < again_s < 3 * PERIOD_S


@pytest.mark.parametrize("kind", [BestResponse, Confirmation, Message])
def test_without_any_agreement_all_try_again_where_they_are(kind: type[Message]) -> None:
    """Nobody goes on with a round that can't be agreed upon; the next one is planned in its
    window, at the same places unless all had confirmed.
    """
    troop = troop_of(lambda _t, _r, m: m.round in (1, 2) and isinstance(m, kind), 6 * PERIOD_S)
    for name in NAMES:
        assert {detail.split()[-1] for detail in details(troop, name)} >= {"round=1", "round=2"}
        assert starts(troop)[name][-3:] == [3, 4, 5]
    held = {held.strategy for agent in troop.agents.values() for held in agent.held}
    assert sorted(strategy.round for strategy in held) == list(range(3, 7))


@pytest.mark.parametrize("seed", range(4))
def test_whatever_is_lost_two_windows_bring_all_together(seed: int) -> None:
    """Most messages of any rounds are lost at random for six windows; when all hear each other
    again, they meet in one of the next two windows, and in all from then on.
    """
    rng = np.random.default_rng(seed)
    troop = Troop(NAMES, lambda t, _r, _m: t < 6 * PERIOD_S and rng.random() < 0.97)
    troop.run(10 * PERIOD_S)
    assert sum(map(len, troop.events(FAULT).values())) > 10
    for rounds in starts(troop).values():
        assert {8, 9} <= set(rounds)
    strategies = [held.strategy for agent in troop.agents.values() for held in agent.held]
    by_round = {strategy.round: strategy for strategy in strategies}
    assert all(by_round[strategy.round] == strategy for strategy in strategies)
