"""An agent node's parameters, validated.

``PARAMETERS``   what they are, with their defaults
``AgentConfig``  who an agent is and how it is paced
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import Final, Self

from tlcomm_core.errors import InputError
from tlcomm_core.game.solver import DEFAULT, SOLVERS, Solver
from tlcomm_core.method import Method, parse_method
from tlcomm_core.pace import Pace, parse_pace
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.model import Scenario

__all__ = ["PARAMETERS", "AgentConfig"]

PARAMETERS: Final[Mapping[str, object]] = MappingProxyType(
    {
        "scenario": "",
        "pace": "lockstep",
        "seed": 0,
        "solver": DEFAULT.name,
        "method": Method.TEAM.value,
        "recorder": False,
    }
)
"""The node's parameters and their defaults."""


@dataclass(frozen=True, slots=True)
class AgentConfig:
    """Who an agent is and how it is paced.

    Attributes:
        name: one of the scenario's agents.
        scenario: all that the team knows from the start.
        pace: lock step, or the clock runs by itself.
        seed: of what befalls it.
        solver: how its team finds the next meetings.
        method: of coordination.
        has_recorder: whether to wait for a recorder before saying that it is ready.
    """

    name: str
    scenario: Scenario
    pace: Pace
    seed: int
    solver: Solver
    method: Method
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
        solver = SOLVERS.get(str(get("solver")))
        if solver is None:
            raise InputError(f"solver: {get('solver')!r} isn't one of {', '.join(SOLVERS)}")
        method = parse_method(str(get("method")))
        method.solver(solver).check_team(len(scenario.agents))
        pace = parse_pace(str(get("pace")))
        return cls(name, scenario, pace, seed, solver, method, bool(get("recorder")))

    @property
    def measures(self) -> bool:
        """Whether agents measure anything."""
        return self.scenario.field is not None

    @property
    def others(self) -> tuple[str, ...]:
        """The other agents, in the scenario's order."""
        return tuple(name for name in self.scenario.agents if name != self.name)
