"""An agent node's parameters, validated.

``AgentConfig``  who an agent is and how it is paced
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Self

from tlcomm_core.errors import InputError
from tlcomm_core.pace import Pace, parse_pace
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.model import Scenario

__all__ = ["AgentConfig"]


@dataclass(frozen=True, slots=True)
class AgentConfig:
    """Who an agent is and how it is paced.

    Attributes:
        name: one of the scenario's agents.
        scenario: all that the team knows from the start.
        pace: lock step, or the clock runs by itself.
        seed: of what befalls it.
        has_recorder: whether to wait for a recorder before saying that it is ready.
    """

    name: str
    scenario: Scenario
    pace: Pace
    seed: int
    has_recorder: bool

    @classmethod
    def from_parameters(cls, namespace: str, get: Callable[[str], object]) -> Self:
        """Read a node's namespace and parameters.

        Raises:
            InputError: one of them is missing, malformed or of no agent.
        """
        path = get("scenario")
        if not isinstance(path, str) or not path:
            raise InputError(f"scenario: {path!r} isn't a file's name")
        scenario = load_scenario(path)
        name = namespace.removeprefix("/")
        if name not in scenario.agents:
            agents = ", ".join(scenario.agents)
            raise InputError(
                f"namespace: {namespace!r} is no agent of {path!r}, which has {agents}"
            )
        seed = get("seed")
        if not (isinstance(seed, int) and seed >= 0):
            raise InputError(f"seed: {seed!r} isn't an integer ≥ 0")
        return cls(name, scenario, parse_pace(str(get("pace"))), seed, bool(get("recorder")))

    @property
    def others(self) -> tuple[str, ...]:
        """The other agents, in the scenario's order."""
        return tuple(name for name in self.scenario.agents if name != self.name)
