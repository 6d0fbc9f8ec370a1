"""A hall with a wall whose door and whose gap beside it close and open while two agents commute.

``gate``  the scenario
"""

from tlcomm_core.scenario.loader import loads
from tlcomm_core.scenario.model import Scenario

__all__ = ["CLOSED_S", "OPENED_S", "SHUT_S", "gate"]

# The door closes while one drives through the hall; the gap too, so that the hall is two rooms;
# then both open.
CLOSED_S, SHUT_S, OPENED_S = 21.3, 110.0, 135.0
_TEXT = f"""\
name: gate
workspace:
  size_m: [8.0, 4.0]
  cell_m: 0.5
  obstacles_m: [[4.0, 0.0, 4.5, 1.0], [4.0, 1.5, 4.5, 3.5]]
  regions:
    a: {{at_m: [0.75, 1.25], radius_m: 0.3}}
    b: {{at_m: [7.25, 1.25], radius_m: 0.3}}
  changes:
    - {{at_s: {CLOSED_S}, obstacles_m: [[4.0, 0.0, 4.5, 3.5]]}}
    - {{at_s: {SHUT_S}, obstacles_m: [[4.0, 0.0, 4.5, 4.0]]}}
    - {{at_s: {OPENED_S}, obstacles_m: [[4.0, 0.0, 4.5, 1.0], [4.0, 1.5, 4.5, 3.5]]}}
communication: {{range_m: 2.0, period_s: 30.0, duration_s: 3.0}}
motion: {{linear_mps: 0.5, angular_radps: 1.5}}
actions: {{pick: 4.0, place: 2.0}}
agents:
  one: {{start: [2.75, 1.25, 0.0], task: "G F ((a & pick) & F (b & place))"}}
  two: {{start: [3.25, 1.25, 0.0], task: "G F ((b & pick) & F (a & place))"}}
"""


def gate() -> Scenario:
    """Return the scenario."""
    return loads(_TEXT)
