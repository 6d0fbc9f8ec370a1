"""Tests of ``tlcomm_core.metrics.connection``."""

from dataclasses import replace

from support.hall import DURATION_S, PERIOD_S, hall
from tlcomm_core.agent.pairs import pairs_of
from tlcomm_core.metrics.connection import connected_intervals, pair_windows_of
from tlcomm_core.records import RunRecords
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.observation import Connectivity


def test_the_last_connection_lasts_to_the_end() -> None:
    """Repeated states don't split an interval, and the last one holds until the end."""
    seen = [
        Connectivity(0, (), False),
        Connectivity(10, ((0, 1),), True),
        Connectivity(20, ((0, 1),), True),
        Connectivity(30, (), False),
        Connectivity(40, ((0, 1),), True),
    ]
    assert connected_intervals(seen, 70) == [(10, 30), (40, 70)]


def test_pairs_keep_windows_of_their_own_by_links_of_their_own() -> None:
    """What counts is the link between the two, in their windows, whoever else is linked."""
    site = hall(3)
    first, second = pairs_of(site)
    assert (first.members, first.first, second.members, second.first) == (
        ("one", "two"),
        1,
        ("one", "three"),
        2,
    )
    short_s = DURATION_S - 0.5
    links = {
        0.0: (),
        PERIOD_S + 1.0: ((0, 1),),
        PERIOD_S + 1.0 + DURATION_S: (),
        2 * PERIOD_S + 1.0: ((0, 1), (1, 2)),
        3 * PERIOD_S - 1.0: (),
        3 * PERIOD_S + 1.0: ((0, 1), (0, 2)),
        3 * PERIOD_S + 1.0 + short_s: ((0, 2),),
        4 * PERIOD_S + DURATION_S: (),
    }
    states = [Connectivity(nanoseconds(at_s), edges, False) for at_s, edges in links.items()]
    records = replace(RunRecords(), connectivity=states)
    found = pair_windows_of(site.scenario, records, nanoseconds(5 * PERIOD_S))
    kept = {pair: [(own.round, own.satisfied) for own in found[pair]] for pair in found}
    assert kept == {first: [(1, True), (3, False)], second: [(2, False), (4, True)]}
    assert found[first][1].longest_ns == nanoseconds(short_s)
