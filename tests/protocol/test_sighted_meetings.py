"""Meetings round a corner, by radios that have to see each other."""

from dataclasses import replace

import pytest

from support.fake_network import FakeNetwork
from support.meetings import Meeting, plant_meeting, reference
from tlcomm_core.agent.charts import Charts
from tlcomm_core.agent.rounds import MeetingRounds
from tlcomm_core.protocol.messages import Message
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.grid import Grid

# Up one side of the wall, over its end and down the other side.
PLACES_M = [(1.75, 3.25), (1.75, 3.75), (1.75, 4.25), (2.75, 4.25), (2.75, 3.75), (2.75, 3.25)]
BEHIND = {("agent_00", "agent_05"), ("agent_01", "agent_04")}
GRID = Grid((6.0, 6.0), 0.5, [(2.0, 1.0, 2.5, 4.0)])


def meeting_round_the_wall(seed: int, clearance_m: float | None) -> Meeting:
    """Return a meeting of six, two pairs of which are in range through the wall."""
    meeting = plant_meeting(6, seed)
    team = replace(meeting.team, planned_range_m=1.1, clearance_m=clearance_m)
    offers = tuple(
        replace(offer, x_m=x_m, y_m=y_m)
        for offer, (x_m, y_m) in zip(meeting.offers, PLACES_M, strict=True)
    )
    return Meeting(offers, meeting.round, team, MeetingRounds(Charts(Atlas(GRID)), team, 0.0), 1.2)


def run(meeting: Meeting) -> FakeNetwork:
    """Return the meeting's end, where nobody hears through the wall."""
    network = FakeNetwork(
        meeting.offers,
        meeting.round,
        meeting.team,
        meeting.rounds,
        range_m=meeting.range_m,
        is_cut=behind_the_wall,
    )
    network.run_until_agreed(within_s=30.0)
    return network


def behind_the_wall(_time_s: float, receiver: str, message: Message) -> bool:
    """Tell whether the wall is between the two."""
    return tuple(sorted((receiver, message.sender))) in BEHIND


@pytest.mark.parametrize("seed", range(3))
def test_a_team_that_minds_the_wall_agrees(seed: int) -> None:
    """It waits for nobody behind the wall, and plans places that see each other."""
    meeting = meeting_round_the_wall(seed, clearance_m=0.02)
    network = run(meeting)
    assert network.is_agreed
    agreed = {negotiation.agreed for negotiation in network.agents.values()}
    assert agreed == {reference(meeting)}


def test_a_team_that_does_not_mind_it_waits_for_ever() -> None:
    """Exchanges through the wall never come: the same team, told that radios needn't see."""
    assert not run(meeting_round_the_wall(0, clearance_m=None)).is_agreed
