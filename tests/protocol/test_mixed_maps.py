"""Teams that meet while the map changes, so that their offers are made with different ones."""

from dataclasses import replace

import numpy as np
import pytest

from support.fake_network import FakeNetwork
from support.meetings import Meeting, plant_meeting
from tlcomm_core.agent.charts import Charts
from tlcomm_core.agent.rounds import MeetingRounds
from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.grid import Grid

# The room of ``plant_meeting``, whose wall is gone from OPENED_NS on, and shut from SHUT_NS on.
ROOM = Grid((6.0, 6.0), 0.5, [(2.0, 1.0, 2.5, 4.0)])
OPENED = Grid((6.0, 6.0), 0.5)
SHUT = Grid((6.0, 6.0), 0.5, [(2.0, 0.0, 2.5, 5.0)])
OPENED_NS, SHUT_NS = 5, 9
# Stops where the wall was.
IN_WALL_M = (2.25, 2.25)


def mixed_offers(meeting: Meeting, rng: np.random.Generator) -> tuple[MemberOffer, ...]:
    """Return offers of which about half are made on the opened map, with a stop in the wall."""
    offers = []
    for offer in meeting.offers:
        stops = list(offer.stops)
        x_m, y_m = IN_WALL_M
        stops[3] = replace(stops[3], x_m=x_m, y_m=y_m)
        late = replace(offer, map_ns=OPENED_NS, stops=tuple(stops))
        offers.append(late if rng.random() < 0.5 else offer)
    return (meeting.offers[0], *offers[1:-1], replace(offers[-1], map_ns=OPENED_NS))


@pytest.mark.parametrize("seed", range(5))
def test_all_agree_whichever_maps_they_know(seed: int) -> None:
    """Also one that knows a later map than was offered with, and one that learns of one late."""
    count, rng = 5, np.random.default_rng(seed)
    meeting = plant_meeting(count, seed)
    offers = mixed_offers(meeting, rng)
    charts = {offer.agent: Charts(Atlas(ROOM)) for offer in offers}
    late = offers[int(rng.integers(count - 1))].agent
    for agent, own in charts.items():
        if agent != late:
            own.take(OPENED_NS, OPENED.free)
            if rng.random() < 0.5:
                own.take(SHUT_NS, SHUT.free)
    network = FakeNetwork(offers, meeting.round, meeting.team, meeting.rounds, range_m=0.6)
    for offer in sorted(offers, key=lambda offer: offer.arrival_s):
        network.rounds = MeetingRounds(charts[offer.agent], meeting.team, 0.0)
        network.run(offer.arrival_s)
    network.run(network.begins_s + 1.0)
    assert not network.is_agreed
    charts[late].take(OPENED_NS, OPENED.free)
    network.run()
    assert network.is_agreed
    assert len({agent.agreed for agent in network.agents.values()}) == 1


def test_on_the_oldest_map_a_later_ones_stops_arent_met_at() -> None:
    """Where the wall was, nobody is to be when another's offer is from before it went."""
    meeting = plant_meeting(3, 1)
    offers = mixed_offers(meeting, np.random.default_rng(1))
    charts = Charts(Atlas(ROOM))
    charts.take(OPENED_NS, OPENED.free)
    rounds = MeetingRounds(charts, meeting.team, 0.0)
    mixed = rounds.problem(2, 70.0, offers).candidates[-1]
    stops = offers[-1].stops
    in_wall = [stop.task_index for stop in stops if (stop.x_m, stop.y_m) == IN_WALL_M]
    before_it = [index - 1 for index in in_wall]
    assert in_wall == [3]
    assert not {*in_wall, *before_it} & {*mixed.task_index.tolist()}
    later = rounds.problem(2, 70.0, [replace(own, map_ns=OPENED_NS) for own in offers])
    assert {*in_wall, *before_it} <= {*later.candidates[-1].task_index.tolist()}
