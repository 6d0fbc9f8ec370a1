"""Strategies as agents exchange them: values, not indices.

``Strategy``      s_i = (z_i, h_i) with its arrival time and extra travel
``TeamStrategy``  S with t_c and Φ, for one round
"""

from dataclasses import dataclass

__all__ = ["Strategy", "TeamStrategy"]


@dataclass(frozen=True, slots=True)
class Strategy:
    """An agent's strategy to attend a meeting.

    Attributes:
        agent: whose.
        x_m: place to communicate at, z.
        y_m: the same.
        task_index: h, index in the agent's local plan after which it goes to communicate.
        arrival_s: t, when it reaches z (simulated time).
        extra_travel_s: δ, the detour's cost in travelling time.
    """

    agent: str
    x_m: float
    y_m: float
    task_index: int
    arrival_s: float
    extra_travel_s: float


@dataclass(frozen=True, slots=True)
class TeamStrategy:
    """What the team decided for a round.

    Attributes:
        round: r ≥ 1.
        iteration: how many moves led from S⁰ here.
        strategies: one per agent, sorted by agent.
        communication_s: t_c = max(max_i t_i, r·T_c).
        potential_s: Φ = Σ_i δ_i + (t_c − t_i).
        initial_potential_s: Φ of S⁰.
        bound_s: no team strategy has a lower Φ; None if nothing is proven.
    """

    round: int
    iteration: int
    strategies: tuple[Strategy, ...]
    communication_s: float
    potential_s: float
    initial_potential_s: float
    bound_s: float | None = None

    @property
    def members(self) -> tuple[str, ...]:
        """Whose strategies these are, sorted."""
        return tuple(own.agent for own in self.strategies)

    def part_of(self, agent: str) -> Strategy:
        """Return a member's own strategy."""
        return next(own for own in self.strategies if own.agent == agent)
