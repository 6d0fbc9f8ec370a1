"""All figures of a run together, by stable names with their units: what methods are compared by.

``Metrics``       what one agent and the team both have
``AgentMetrics``  of one agent
``TeamMetrics``   of the team
``Computing``     wall times, the only figures in which equal runs differ
``RunMetrics``    all of them

What isn't available is ``None``. Figures of the team are sums over agents where they count or add
up (tasks, own work, what is lost, distance, messages), means over agents otherwise; a sum or mean
over agents isn't available unless each agent's figure is.
"""

from dataclasses import asdict, dataclass
from typing import Any

__all__ = ["AgentMetrics", "Computing", "Metrics", "RunMetrics", "TeamMetrics"]


@dataclass(frozen=True, slots=True, kw_only=True)
class Metrics:
    """What one agent and the team both have; deviations in the field's unit.

    Attributes:
        tasks_satisfied: K.
        tasks_per_hour: the same per hour.
        mean_cycle_s: mean time between two satisfactions.
        meetings: how many agreed meetings took place, with the agent; that at t = 0 isn't agreed.
        detour_s: δ_i, mean over meetings and those who met.
        wait_s: t_c − t_i, as ``detour_s``.
        additional_s: δ_i + (t_c − t_i), as ``detour_s``.
        additional_with_duration_s: the same and D_c.
        own_work_s: what the steps done take alone.
        lost_s: what they took more than that.
        lost_per_window_s: the same per T_c.
        lost_per_meeting_s: the same per meeting that ended, by a method with meetings.
        information_age_mean_s: of what agents have of the others, over time.
        information_age_max_s: the largest.
        deviation_mean: of estimates from the field, over time (and agents).
        deviation_max: the largest.
        deviation_settled_max: the largest from 2·T_c on.
        distance_m: driven.
        messages: said.
        bytes: said.
    """

    tasks_satisfied: int
    tasks_per_hour: float | None
    mean_cycle_s: float | None
    meetings: int
    detour_s: float | None
    wait_s: float | None
    additional_s: float | None
    additional_with_duration_s: float | None
    own_work_s: float | None
    lost_s: float | None
    lost_per_window_s: float | None
    lost_per_meeting_s: float | None
    information_age_mean_s: float | None
    information_age_max_s: float | None
    deviation_mean: float | None
    deviation_max: float | None
    deviation_settled_max: float | None
    distance_m: float
    messages: int | None
    bytes: int | None


@dataclass(frozen=True, slots=True, kw_only=True)
class AgentMetrics(Metrics):
    """One agent's figures.

    Attributes:
        makespan_s: ξ_i.
    """

    makespan_s: float | None


@dataclass(frozen=True, slots=True, kw_only=True)
class TeamMetrics(Metrics):
    """The team's figures.

    Attributes:
        makespan_sum_s: Σ_i ξ_i.
        makespan_max_s: max_i ξ_i.
        team_meetings: those of the ``meetings`` that were the whole team's.
        pair_meetings: those of two agents, in a larger team.
        windows: how many are decided.
        windows_kept: in how many of them the team was connected for D_c.
        windows_missed: in how many it wasn't.
    """

    makespan_sum_s: float | None
    makespan_max_s: float | None
    team_meetings: int
    pair_meetings: int
    windows: int
    windows_kept: int
    windows_missed: int


@dataclass(frozen=True, slots=True)
class Computing:
    """What coordination takes in wall time; means over the meetings, or turns, agreed on.

    Attributes:
        solve_wall_s: own computing of each round's slowest agent.
        coordination_wall_s: from the complete team to the last agreement.
    """

    solve_wall_s: float | None
    coordination_wall_s: float | None


@dataclass(frozen=True, slots=True)
class RunMetrics:
    """All figures of a run.

    Attributes:
        team: of the team.
        agents: of each agent, by name.
        computing: in wall time.
    """

    team: TeamMetrics
    agents: dict[str, AgentMetrics]
    computing: Computing

    def document(self) -> dict[str, Any]:
        """Return the figures by their names, ready for ``json.dumps``; fresh."""
        return asdict(self)
