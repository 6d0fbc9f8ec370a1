"""The corridor, where agents measure wherever they place something."""

from pathlib import Path

from tlcomm_core.scenario.loader import loads
from tlcomm_core.scenario.model import Scenario

__all__ = ["measuring_corridor"]

_CORRIDOR = Path(__file__).parents[2] / "scenarios" / "corridor.yaml"
_FIELD = """
field:
  action: place
  profile: [[0, 50.0], [300, 53.0]]
  drift:
    amplitude: 1.0
    frequency_radps: 0.01
    phases_rad: {west_bench: 0.0, east_bench: 2.0, east_shelf: 4.0}
  noise: NOISE
  exchange: {mode: MODE}
"""


def measuring_corridor(*, noise: float = 0.2, mode: str = "consensus") -> Scenario:
    """Return the scenario."""
    section = _FIELD.replace("NOISE", repr(noise)).replace("MODE", mode)
    return loads(_CORRIDOR.read_text("utf-8") + section)
