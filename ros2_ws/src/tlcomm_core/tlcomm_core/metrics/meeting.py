"""Meetings as they took place, and what they cost each member beyond its own work.

``Meeting``   an agreed meeting with its members' arrivals
``meetings``  all of them

With s_i = (z_i, h_i) as agreed, and t_i as realised, member i's additional time is

    ξ_i = δ_i + (t_c − t_i),   t_c = max(max_i t_i, r·T_c),

its detour δ_i = T(π^h, z) + T(z, π^{h+1}) − T(π^h, π^{h+1}) and its wait. The meeting itself takes
every member D_c more.

Source: equation (5) of the paper, which leaves D_c out, as it is the same for all; equation (6).
"""

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.game.strategy import TeamStrategy
from tlcomm_core.records import RunRecords
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.units import seconds

__all__ = ["Meeting", "meetings"]


@dataclass(frozen=True, slots=True)
class Meeting:
    """An agreed meeting: of the team, or of a pair.

    Attributes:
        strategy: as agreed; its members are those who meet.
        opens_s: when its window does, r·T_c.
        arrivals_s: when members reached their places; only of those that did.
    """

    strategy: TeamStrategy
    opens_s: float
    arrivals_s: Mapping[str, float]

    @property
    def round(self) -> int:
        """The meeting's number r, that of its window."""
        return self.strategy.round

    @property
    def members(self) -> tuple[str, ...]:
        """Who meets, sorted."""
        return self.strategy.members

    @property
    def starts_s(self) -> float | None:
        """Realised t_c = max(max_i t_i, r·T_c); ``None`` if not all reached their places."""
        if any(name not in self.arrivals_s for name in self.members):
            return None
        return max(self.opens_s, *(self.arrivals_s[name] for name in self.members))

    @property
    def detour_s(self) -> dict[str, float]:
        """Planned δ_i of each member."""
        return {own.agent: own.extra_travel_s for own in self.strategy.strategies}

    @property
    def wait_s(self) -> dict[str, float]:
        """Realised t_c − t_i of each member; empty if not all reached their places."""
        starts_s = self.starts_s
        if starts_s is None:
            return {}
        return {name: starts_s - self.arrivals_s[name] for name in self.members}

    @property
    def additional_s(self) -> dict[str, float]:
        """ξ_i = δ_i + (t_c − t_i) of each member; empty if not all reached their places."""
        detour_s = self.detour_s
        return {name: detour_s[name] + wait_s for name, wait_s in self.wait_s.items()}

    def took_place_by(self, end_s: float) -> bool:
        """Return whether it has begun by a time."""
        return self.starts_s is not None and self.starts_s <= end_s


def meetings(scenario: Scenario, records: RunRecords) -> tuple[Meeting, ...]:
    """Return the meetings that members agreed on, by round and members.

    That at t = 0 isn't agreed on, and isn't among them. Where members hold different strategies
    for a round, the one that was held first counts.
    """
    held: dict[tuple[int, tuple[str, ...]], TeamStrategy] = {}
    for record in records.strategies:
        strategy = record.strategy
        held.setdefault((strategy.round, strategy.members), strategy)
    arrivals_s = _arrivals_s(records)
    period_s = scenario.communication.period_s
    return tuple(
        Meeting(
            strategy,
            number * period_s,
            {name: arrivals_s[number][name] for name in members if name in arrivals_s[number]},
        )
        for (number, members), strategy in sorted(held.items(), key=lambda item: item[0])
    )


def _arrivals_s(records: RunRecords) -> dict[int, dict[str, float]]:
    """Return per round when each agent reached its place."""
    arrivals: dict[int, dict[str, float]] = defaultdict(dict)
    for record in records.tasks:
        if record.event.kind is TaskEventKind.MEETING_REACHED:
            # The last: an agent that was cut off from its place may have waited elsewhere first.
            arrivals[record.event.round][record.agent] = seconds(record.stamp_ns)
    return arrivals
