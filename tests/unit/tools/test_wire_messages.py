"""Tests of ``tlcomm_tools.wire_messages``: what a bag's decoder returns, as values.

That every kind of team message comes back to the bit is a test of recordings.
"""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from tlcomm_core.agent.actions import Drive
from tlcomm_core.errors import InputError
from tlcomm_core.protocol.messages import EstimateExchange, Proposal
from tlcomm_core.world.observation import Reading
from tlcomm_tools.wire_messages import read_command, read_map, read_reading, read_team_message

STAMP = SimpleNamespace(stamp=SimpleNamespace(sec=1, nanosec=5))


def grid(*cells: int, width: int = 3, height: int = 2) -> SimpleNamespace:
    """Return a map."""
    info = SimpleNamespace(width=width, height=height)
    return SimpleNamespace(info=info, data=np.array(cells, dtype=np.int8))


def proposal(**changes: object) -> SimpleNamespace:
    """Return a proposal of nobody's strategies."""
    whole = {"sender": "west", "round": 1, "iteration": 1, "hop": 2, "candidate": "east"}
    return SimpleNamespace(**whole, **{"potential": 3.0, "bound": 2.0, "strategies": []} | changes)


def exchange(value: float) -> SimpleNamespace:
    """Return what somebody takes the field to be."""
    return SimpleNamespace(sender="west", step=3, neighbours=1, asks=False, value=value, known=[])


def test_cells_are_free_as_agents_read_them() -> None:
    """Row by row; what is unknown, or occupied as likely as not, isn't free."""
    expected = [[True, False, False], [True, False, True]]
    assert read_map(grid(0, 100, -1, 49, 50, 0)).tolist() == expected


def test_a_map_of_too_few_cells_is_refused() -> None:
    """Its sizes and its cells must agree."""
    with pytest.raises(InputError, match="a map of 3 x 2 cells has 4 of them"):
        read_map(grid(0, 0, 0, 0))


def test_a_bound_may_be_missing() -> None:
    """Where nothing is proven it is −inf; other numbers are finite."""
    read = read_team_message(proposal(bound=-math.inf), "proposal")
    assert isinstance(read, Proposal)
    assert read.bound_s == -math.inf
    for changes in ({"bound": math.nan}, {"bound": math.inf}, {"potential": -math.inf}):
        with pytest.raises(InputError, match="isn't finite"):
            read_team_message(proposal(**changes), "proposal")


def test_estimates_and_readings_are_finite() -> None:
    """What isn't no agent would have heard."""
    read = read_team_message(exchange(1.5), "estimate_exchange")
    assert read == EstimateExchange("west", 3, 1, asks=False, value=1.5)
    with pytest.raises(InputError, match="value: inf isn't finite"):
        read_team_message(exchange(math.inf), "estimate_exchange")
    reading = SimpleNamespace(header=STAMP, agent="west", region="shelf", value=2.5)
    assert read_reading(reading) == Reading(1_000_000_005, "west", "shelf", 2.5)
    reading.value = math.nan
    with pytest.raises(InputError, match="value: nan isn't finite"):
        read_reading(reading)


def test_commands_are_read_as_they_are() -> None:
    """Along x and round z."""
    linear, angular = SimpleNamespace(x=0.5, y=7.0), SimpleNamespace(x=7.0, z=-1.5)
    twist = SimpleNamespace(linear=linear, angular=angular)
    assert read_command(SimpleNamespace(twist=twist)) == Drive(0.5, -1.5)
