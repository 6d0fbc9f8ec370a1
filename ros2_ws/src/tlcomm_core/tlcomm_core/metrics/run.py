"""The figures of a run, from its records.

``run_metrics``  all of them
"""

import statistics
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Final, TypeVar

from tlcomm_core.method import Method
from tlcomm_core.metrics.connection import windows_of
from tlcomm_core.metrics.coordination import coordination_wall_s, indexed, solve_wall_s, timings_of
from tlcomm_core.metrics.deviation import SETTLED_PERIODS, Deviation, deviation_of_team, deviations
from tlcomm_core.metrics.distance import distance_m
from tlcomm_core.metrics.information_age import InformationAge, information_age
from tlcomm_core.metrics.lost_time import LostTime, lost_time
from tlcomm_core.metrics.meeting import Meeting, meetings
from tlcomm_core.metrics.satisfaction import makespan_s, mean_cycle_s, satisfied_ns, tasks_per_hour
from tlcomm_core.metrics.summary import AgentMetrics, Computing, RunMetrics, TeamMetrics
from tlcomm_core.records import RunRecords
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.units import nanoseconds, seconds
from tlcomm_core.windows import Window

__all__ = ["run_metrics"]

_Number = TypeVar("_Number", int, float)

_PAIR: Final = 2


def run_metrics(scenario: Scenario, records: RunRecords, method: Method, end_ns: int) -> RunMetrics:
    """Return the figures of a run.

    Args:
        scenario: what was run.
        records: what happened, each list in order of time.
        method: of coordination.
        end_ns: when the run ended.
    """
    run = _Run.of(scenario, records, method, end_ns)
    agents = {name: _agent_metrics(run, name) for name in scenario.agents}
    return RunMetrics(_team_metrics(run, list(agents.values())), agents, _computing(run))


@dataclass(frozen=True, slots=True)
class _Run:
    """What the figures of all agents are taken from.

    Attributes:
        agreed: what was agreed on: meetings or, by a method without any, turns.
        met: the meetings that took place.
        windows: all that are decided.
        settled: deviations after the start.
    """

    scenario: Scenario
    records: RunRecords
    end_ns: int
    has_meetings: bool
    agreed: tuple[Meeting, ...]
    met: tuple[Meeting, ...]
    lost: Mapping[str, LostTime]
    windows: tuple[Window, ...]
    ages: InformationAge | None
    deviations: Mapping[str, Deviation]
    settled: Mapping[str, Deviation]

    @property
    def end_s(self) -> float:
        """When the run ended."""
        return seconds(self.end_ns)

    @classmethod
    def of(cls, scenario: Scenario, records: RunRecords, method: Method, end_ns: int) -> "_Run":
        """Return it; the arguments are those of ``run_metrics``."""
        agreed = meetings(scenario, records)
        met = [own for own in agreed if method.has_meetings and own.took_place_by(seconds(end_ns))]
        settled_ns = nanoseconds(SETTLED_PERIODS * scenario.communication.period_s)
        return cls(
            scenario=scenario,
            records=records,
            end_ns=end_ns,
            has_meetings=method.has_meetings,
            agreed=agreed,
            met=tuple(met),
            windows=windows_of(scenario, records, end_ns),
            lost=lost_time(scenario, records),
            ages=information_age(records.connectivity, len(scenario.agents), end_ns),
            deviations=deviations(scenario, records.estimates, end_ns),
            settled=deviations(scenario, records.estimates, end_ns, settled_ns),
        )


@dataclass(frozen=True, slots=True)
class _Costs:
    """Means over meetings and those who met."""

    detour_s: float | None
    wait_s: float | None
    additional_s: float | None
    additional_with_duration_s: float | None

    @classmethod
    def of(cls, run: _Run, members: Iterable[str]) -> "_Costs":
        """Return what meetings cost some agents on average."""
        wanted = frozenset(members)
        met = [(own, name) for own in run.met for name in own.members if name in wanted]
        detour_s = _mean(own.detour_s[name] for own, name in met)
        wait_s = _mean(own.wait_s[name] for own, name in met)
        additional_s = _mean(own.additional_s[name] for own, name in met)
        duration_s = run.scenario.communication.duration_s
        whole_s = None if additional_s is None else additional_s + duration_s
        return cls(detour_s, wait_s, additional_s, whole_s)


def _agent_metrics(run: _Run, name: str) -> AgentMetrics:
    moments_ns = satisfied_ns(name, run.records)
    period_s = run.scenario.communication.period_s
    lost = run.lost.get(name)
    deviation, settled = run.deviations.get(name), run.settled.get(name)
    number = list(run.scenario.agents).index(name)
    return AgentMetrics(
        tasks_satisfied=len(moments_ns),
        tasks_per_hour=tasks_per_hour(len(moments_ns), run.end_s),
        makespan_s=makespan_s(moments_ns),
        mean_cycle_s=mean_cycle_s(moments_ns),
        meetings=sum(name in meeting.members for meeting in run.met),
        **asdict(_Costs.of(run, [name])),
        own_work_s=None if lost is None else lost.own_work_s[-1],
        lost_s=None if lost is None else lost.lost_s[-1],
        lost_per_window_s=None if lost is None else lost.per_window_s(period_s),
        lost_per_meeting_s=lost.per_meeting_s if lost and run.has_meetings else None,
        information_age_mean_s=None if run.ages is None else run.ages.mean_of_s(number),
        information_age_max_s=None if run.ages is None else run.ages.most_of_s(number),
        deviation_mean=None if deviation is None else deviation.mean,
        deviation_max=None if deviation is None else deviation.most,
        deviation_settled_max=None if settled is None else settled.most,
        distance_m=distance_m(name, run.records),
        messages=run.records.messages_sent.get(name),
        bytes=run.records.bytes_sent.get(name),
    )


def _team_metrics(run: _Run, agents: Sequence[AgentMetrics]) -> TeamMetrics:
    kept = [window.satisfied for window in run.windows]
    sizes = [len(meeting.members) for meeting in run.met]
    team = len(agents)
    deviation, settled = deviation_of_team(run.deviations), deviation_of_team(run.settled)
    return TeamMetrics(
        tasks_satisfied=sum(own.tasks_satisfied for own in agents),
        tasks_per_hour=_sum(own.tasks_per_hour for own in agents),
        makespan_sum_s=_sum(own.makespan_s for own in agents),
        makespan_max_s=_max(own.makespan_s for own in agents),
        mean_cycle_s=_mean(own.mean_cycle_s for own in agents),
        meetings=len(sizes),
        team_meetings=sizes.count(team),
        pair_meetings=0 if team == _PAIR else sizes.count(_PAIR),
        windows=len(kept),
        windows_kept=kept.count(True),
        windows_missed=kept.count(False),
        **asdict(_Costs.of(run, run.scenario.agents)),
        own_work_s=_sum(own.own_work_s for own in agents),
        lost_s=_sum(own.lost_s for own in agents),
        lost_per_window_s=_mean(own.lost_per_window_s for own in agents),
        lost_per_meeting_s=_mean(own.lost_per_meeting_s for own in agents),
        information_age_mean_s=_mean(own.information_age_mean_s for own in agents),
        information_age_max_s=_max(own.information_age_max_s for own in agents),
        deviation_mean=None if deviation is None else deviation.mean,
        deviation_max=None if deviation is None else deviation.most,
        deviation_settled_max=None if settled is None else settled.most,
        distance_m=sum(own.distance_m for own in agents),
        messages=_sum(own.messages for own in agents),
        bytes=_sum(own.bytes for own in agents),
    )


def _computing(run: _Run) -> Computing:
    index = indexed(run.records.timings)
    known = [(timings_of(own, index), len(own.members)) for own in run.agreed]
    solve_s = [solve_wall_s(timings) for timings, _ in known]
    coordination_s = [coordination_wall_s(timings, members) for timings, members in known]
    return Computing(
        solve_wall_s=_mean(time_s for time_s in solve_s if time_s is not None),
        coordination_wall_s=_mean(time_s for time_s in coordination_s if time_s is not None),
    )


def _known(values: Iterable[_Number | None]) -> list[_Number]:
    """Return the values, or none at all if any isn't available."""
    found = list(values)
    known = [value for value in found if value is not None]
    return known if len(known) == len(found) else []


def _sum(values: Iterable[_Number | None]) -> _Number | None:
    known = _known(values)
    return sum(known[1:], known[0]) if known else None


def _mean(values: Iterable[float | None]) -> float | None:
    known = _known(values)
    return statistics.fmean(known) if known else None


def _max(values: Iterable[float | None]) -> float | None:
    return max(_known(values), default=None)
