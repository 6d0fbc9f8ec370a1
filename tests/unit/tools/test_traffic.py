"""What agents say while they plan a round."""

from support.command import CORRIDOR
from tlcomm_core.game.solver import BEST_RESPONSE, COALITION
from tlcomm_core.mission import Mission
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate
from tlcomm_tools.instances import random_site
from tlcomm_tools.traffic import (
    RoundTraffic,
    TrafficRow,
    format_traffic,
    listen,
    measure_traffic,
)

SITE = Site.from_scenario(load_scenario(CORRIDOR))


def test_rounds_together_are_all_that_is_said() -> None:
    """No message is counted twice or left out, and each with its length."""
    heard = listen(SITE, 2, BEST_RESPONSE)
    records = simulate(Mission(SITE, 0, 1, None, BEST_RESPONSE)).records
    team = len(SITE.scenario.agents)
    assert len(heard) == 2
    assert round(team * sum(own.messages for own in heard)) == sum(records.messages_sent.values())
    assert round(team * sum(own.sent_bytes for own in heard)) == sum(records.bytes_sent.values())
    assert all(0 < own.offer_bytes < own.sent_bytes for own in heard)


def test_exchanges_are_whole_consensuses_and_take_their_time() -> None:
    """Each minimum consensus takes D exchanges, and each exchange a hop's latency at least."""
    latency_s = SITE.scenario.communication.hop_latency_s
    records = simulate(Mission(SITE, 0, 1, None, BEST_RESPONSE)).records
    moves = {own.strategy.round: own.strategy.iteration for own in records.strategies}
    for number, own in enumerate(listen(SITE, 2, BEST_RESPONSE), start=1):
        # Besides the moves, one iteration finds that nothing is left in the balls, one nowhere.
        assert own.exchanges == own.diameter * (moves[number] + 2)
        assert own.exchanges * latency_s < own.agreed_s < SITE.scenario.communication.duration_s


def test_a_row_has_the_medians_of_its_rounds() -> None:
    """Of each figure by itself, a row for each size and solver."""
    rows = list(measure_traffic((3, 4), (BEST_RESPONSE, COALITION), scenarios=1, rounds=3))
    assert [(row.agents, row.solver, row.rounds) for row in rows] == [
        (3, "best-response", 3),
        (3, "coalition", 3),
        (4, "best-response", 3),
        (4, "coalition", 3),
    ]
    heard = listen(random_site(4, 0), 3, COALITION)
    assert rows[3].median.messages == sorted(own.messages for own in heard)[1]
    assert rows[3].median.agreed_s == sorted(own.agreed_s for own in heard)[1]


def test_a_table_has_a_line_for_each_row() -> None:
    """Bytes are told in thousands."""
    median = RoundTraffic(3.0, 6.0, 26.5, 21_430.5, 17_360.0, 0.09)
    lines = format_traffic([TrafficRow(8, "coalition", 9, median)]).splitlines()
    assert lines[:2] == [
        "  solver     N  D  exchanges  messages    kB  offers/kB  agreed/s",
        "  coalition  8  3          6      26.5  21.4       17.4     0.090",
    ]
    assert max(map(len, lines)) <= 80
