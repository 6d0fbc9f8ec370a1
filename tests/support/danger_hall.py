"""A hall whose middle is a danger: straight from west to east leads through it."""

from tlcomm_core.scenario.loader import loads
from tlcomm_core.scenario.model import Scenario

__all__ = ["danger_hall"]

_HALL = """\
name: danger_hall
workspace:
  size_m: [7.0, 5.0]
  cell_m: 0.5
  regions:
    west: {at_m: [0.75, 2.75], radius_m: 0.3}
    east: {at_m: [6.25, 2.75], radius_m: 0.3}
    danger: {at_m: [3.5, 2.6], radius_m: 0.9}
communication: {range_m: 1.0, period_s: 40.0, duration_s: 3.0}
motion: {linear_mps: 1.0, angular_radps: 1.5}
actions: {ACTIONS}
agents:
  careful: {start: [2.25, 1.25, 0.0], task: "TASK"}
  bold: {start: [2.75, 1.25, 0.0], task: "G F ((east & load) & F (west & load))"}
"""


def danger_hall(
    task: str = "G !danger & G F ((west & load) & F (east & load))",
    actions: str = "load: 2.0",
) -> Scenario:
    """Return a hall where only the task of ``careful`` forbids the danger.

    Args:
        task: of ``careful``.
        actions: of both.
    """
    return loads(_HALL.replace("TASK", task).replace("ACTIONS", actions))
