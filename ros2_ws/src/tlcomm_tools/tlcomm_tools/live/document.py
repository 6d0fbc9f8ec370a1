"""The document of a page, growing.

``LiveDocument``  told what happens, it tells what is new
"""

import statistics
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, Final

from tlcomm_core.method import Method
from tlcomm_core.metrics.satisfaction import makespan_s, mean_cycle_s
from tlcomm_core.protocol.messages import BestResponse
from tlcomm_core.records import EstimateRecord, RunRecords, StrategyRecord, TaskRecord
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.units import nanoseconds, seconds
from tlcomm_core.world.observation import Connectivity, Odometry
from tlcomm_tools.bag.reader import RecordedRun
from tlcomm_tools.figures import reduction
from tlcomm_tools.live.growing import Edit, Growing, Part, Value
from tlcomm_tools.live.rounds import Rounds
from tlcomm_tools.live.way import Way
from tlcomm_tools.live.windows import Windows
from tlcomm_tools.report.document import finite, report_document
from tlcomm_tools.report.links import Links
from tlcomm_tools.report.plans import COLUMNS, Corner, Plans
from tlcomm_tools.report.steps import done_steps, incidents

__all__ = ["LiveDocument"]

_COSTS: Final = ("detour_s", "wait_s", "additional_s")


class LiveDocument:
    """The document of a run that goes on: that of a report, without what only its end can tell.

    Attributes:
        begun: as it is before the run begins.
    """

    def __init__(self, scenario: Scenario, method: Method, notes: Mapping[str, str]) -> None:
        """Begin before the run.

        Args:
            scenario: what is run.
            method: of coordination.
            notes: what a bag says about the run besides its messages.
        """
        nothing = RecordedRun(RunRecords(), tuple(scenario.agents), 0, dict(notes), "")
        self.begun: Final = report_document(scenario, method, nothing)
        # What only the end can tell; how it ended is told then.
        self.begun["audit"] = None
        self.begun["run"]["verdict"] = None
        self._scenario: Final = scenario
        self._end_ns = 0
        self._agents: Final = {name: _Agent(number) for number, name in enumerate(scenario.agents)}
        self._air: Final = Growing("links")
        self._links: Final = Links(len(scenario.agents))
        self._listed: Final = Growing("rounds")
        self._rounds: Final = Rounds(self._listed, scenario, method)
        communication = scenario.communication
        self._decided: Final = Growing("windows")
        self._windows: Final = Windows(
            self._decided, communication.period_s, communication.duration_s
        )
        self._incidents: Final = Growing("incidents")
        self._end: Final = Value("run", "end_s", value=self.begun["run"]["end_s"])
        self._verdict: Final = Value("run", "verdict", value=None)
        self._field: Final = Value("field", value=self.begun["field"])
        self._metrics: Final = Value("metrics", value=self.begun["metrics"])
        self._parts: Final[tuple[Part, ...]] = (
            self._end,
            self._field,
            self._air,
            self._listed,
            self._decided,
            self._incidents,
            self._metrics,
            self._verdict,
            *(part for own in self._agents.values() for part in own.parts),
        )

    def pass_time(self, stamp_ns: int) -> None:
        """Take that a time has come."""
        self._end_ns = max(self._end_ns, stamp_ns)

    def take_odometry(self, seen: Odometry) -> None:
        """Take an agent's pose."""
        self.pass_time(seen.stamp_ns)
        self._agents[seen.agent].way.take(seen)

    def take_connectivity(self, graph: Connectivity) -> None:
        """Take the radio graph."""
        self.pass_time(graph.stamp_ns)
        self._links.follow(graph)
        self._windows.follow(graph)

    def take_event(self, record: TaskRecord) -> None:
        """Take what an agent did, if it is one of the team."""
        self.pass_time(record.stamp_ns)
        if record.agent in self._agents:
            self._agents[record.agent].take_event(record)
            self._rounds.take_event(record)
            for own in incidents([record]):
                self._incidents.append(own)

    def take_strategy(self, record: StrategyRecord) -> None:
        """Take what an agent holds as agreed."""
        self.pass_time(record.stamp_ns)
        self._rounds.take_strategy(record)

    def take_estimate(self, record: EstimateRecord) -> None:
        """Take what an agent takes the field for, if it is one of the team."""
        self.pass_time(record.stamp_ns)
        if record.agent in self._agents:
            self._agents[record.agent].take_estimate(record)

    def take_plan(self, agent: str, stamp_ns: int, corners: Sequence[Corner]) -> None:
        """Take which corners are before an agent."""
        self._agents[agent].take_plan(stamp_ns, corners)

    def take_response(self, said: BestResponse) -> None:
        """Take what an agent told of a best response."""
        self._rounds.take_response(said)

    def end(self, verdict: str | list[str]) -> None:
        """Take that the run is over, and what it says of itself: "ok", or what failed."""
        self._verdict.value = verdict

    def news(self) -> list[Edit]:
        """Return what is new since the last call."""
        self._draw()
        return _ready(edit for part in self._parts for edit in part.news())

    def whole(self) -> list[Edit]:
        """Return all up to the last ``news``, as changes of what the run began with."""
        return _ready(edit for part in self._parts for edit in part.whole())

    def _draw(self) -> None:
        end_s = seconds(self._end_ns)
        self._end.value = end_s
        self._field.value = _dump(reduction.field(self._scenario, end_s))
        self._air.close(self._links.closed, self._links.open(end_s))
        self._windows.advance(self._end_ns)
        self._rounds.draw(end_s)
        for own in self._agents.values():
            own.draw(end_s)
        self._metrics.value = self._measure()

    def _measure(self) -> dict[str, Any]:
        """Return the figures that are known while a run goes on; the others aren't available."""
        begun = self.begun["metrics"]
        agents = {
            name: {**begun["agents"][name], **own.figures()} for name, own in self._agents.items()
        }
        met = [
            member
            for own in self._listed.items
            if own["started_s"] is not None
            for member in own["members"]
        ]
        spans_s = [own["makespan_s"] for own in agents.values()]
        team = {
            "tasks_satisfied": sum(own["tasks_satisfied"] for own in agents.values()),
            "makespan_max_s": None if None in spans_s else max(spans_s),
            "distance_m": sum(own["distance_m"] for own in agents.values()),
            **{
                name: statistics.fmean(own[name] for own in met) if met else None for name in _COSTS
            },
        }
        return {**begun, "team": {**begun["team"], **team}, "agents": agents}


class _Agent:
    """The parts of a document that are one agent's."""

    def __init__(self, number: int) -> None:
        own = ("agents", number)
        self.way: Final = Way(Growing(*own, "path", columns=("times_s", "x_m", "y_m")))
        self._doings: Final = reduction.Doings()
        self._spans: Final = Growing(*own, "spans")
        self._satisfied: Final = Growing(*own, "satisfied_s")
        self._steps: Final = Growing(*own, "steps")
        self._estimates: Final = Growing(*own, "estimates", columns=("times_s", "values"))
        self._plans: Final = Plans()
        self._ways: Final = Growing(*own, "ways")
        self._ahead: Final = Growing(*own, "ahead", columns=COLUMNS)
        self.parts: Final = (
            self.way.corners,
            self._spans,
            self._satisfied,
            self._steps,
            self._estimates,
            self._ways,
            self._ahead,
        )

    def take_event(self, record: TaskRecord) -> None:
        self._doings.follow(record)
        for time_s in reduction.satisfactions_s([record]):
            self._satisfied.append(time_s)
        for step in done_steps([record]):
            self._steps.append(step)

    def take_estimate(self, record: EstimateRecord) -> None:
        last = self._estimates.items[-2:]
        start = len(self._estimates.items) - len(last)
        reduction.add_estimate(last, record)
        self._estimates.replace(start, last)

    def take_plan(self, stamp_ns: int, corners: Sequence[Corner]) -> None:
        self._plans.take(stamp_ns, corners)
        self._ways.close(self._plans.ways, ())
        self._ahead.close(self._plans.rows, ())

    def draw(self, end_s: float) -> None:
        self.way.draw()
        self._spans.close(self._doings.closed, self._doings.open(end_s), _dump)

    def figures(self) -> dict[str, Any]:
        moments_ns = [nanoseconds(time_s) for time_s in self._satisfied.items]
        return {
            "tasks_satisfied": len(moments_ns),
            "makespan_s": makespan_s(moments_ns),
            "mean_cycle_s": mean_cycle_s(moments_ns),
            "distance_m": self.way.length_m,
        }


def _dump(model: Any) -> Any:  # noqa: ANN401
    return None if model is None else model.model_dump(mode="json")


def _ready(edits: Iterable[Edit]) -> list[Edit]:
    return [finite(edit) for edit in edits]
