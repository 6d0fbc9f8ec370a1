"""What an audit looks at: the records of a run, and what follows from them alone.

``Evidence``      a run as it was
``usable_parts``  of what was recorded
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

from tlcomm_core.records import RunRecords, TaskRecord
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.world.observation import Odometry
from tlcomm_tools.audit.finiteness import keep_finite
from tlcomm_tools.audit.links import Interval, WindowFinding, judge_windows, team_intervals
from tlcomm_tools.audit.membership import keep_members
from tlcomm_tools.audit.tracks import Track, build_tracks

__all__ = ["Evidence", "usable_parts"]


@dataclass(frozen=True, eq=False)
class Evidence:
    """A run as it was.

    Attributes:
        scenario: what was asked for.
        records: what was recorded, as far as it is usable.
        end_s: end of the run.
        track_of: where each agent was; nothing of agents without odometry.
        faults: what isn't usable, and where odometry is missing, a line each.
    """

    scenario: Scenario
    records: RunRecords
    end_s: float
    track_of: dict[str, Track]
    faults: tuple[str, ...]

    @classmethod
    def gather(cls, scenario: Scenario, records: RunRecords, end_s: float) -> "Evidence":
        """Return what a run's records tell."""
        usable, flaws = usable_parts(scenario, records)
        tracks, faults = build_tracks(usable.odometry, tuple(scenario.agents), end_s)
        track_of = {track.agent: track for track in tracks}
        return cls(scenario, usable, end_s, track_of, (*flaws, *faults))

    @property
    def agents(self) -> tuple[str, ...]:
        """All of them, in the scenario's order."""
        return tuple(self.scenario.agents)

    @cached_property
    def connected(self) -> list[Interval]:
        """When the whole team was connected, ascending."""
        return self._together(self.agents)

    @cached_property
    def windows(self) -> list[WindowFinding]:
        """Every window's outcome for the whole team."""
        return self._judge(self.connected)

    def windows_of(self, agents: Sequence[str]) -> list[WindowFinding]:
        """Return every window's outcome for a part of the team, by itself."""
        return self._judge(self._together(agents))

    def events_of(self, agent: str) -> list[TaskRecord]:
        """Return an agent's own events, in order of time."""
        return self._events.get(agent, [])

    def samples_of(self, agent: str) -> list[Odometry]:
        """Return an agent's own odometry, in order of time."""
        return [sample for sample in self.records.odometry if sample.agent == agent]

    def _together(self, agents: Sequence[str]) -> list[Interval]:
        if not self.track_of.keys() >= set(agents):
            return []
        walls = self.scenario.workspace.obstacles_m if self.scenario.radio.line_of_sight else ()
        tracks = [self.track_of[agent] for agent in agents]
        return team_intervals(tracks, self.scenario.communication.range_m, walls)

    @cached_property
    def _events(self) -> dict[str, list[TaskRecord]]:
        events: dict[str, list[TaskRecord]] = {}
        for record in self.records.tasks:
            events.setdefault(record.agent, []).append(record)
        return events

    def _judge(self, intervals: Sequence[Interval]) -> list[WindowFinding]:
        links = self.scenario.communication
        return judge_windows(intervals, links.period_s, links.duration_s, self.end_s)


def usable_parts(scenario: Scenario, records: RunRecords) -> tuple[RunRecords, tuple[str, ...]]:
    """Return the scenario's agents' records that are numbers, and a line for each other kind."""
    ours, strangers = keep_members(records, frozenset(scenario.agents))
    finite, flaws = keep_finite(ours)
    return finite, (*strangers, *flaws)
