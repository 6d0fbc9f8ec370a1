"""A run as far as it is drawn: small, frozen, and the same after a way through JSON.

``Trace``         the run
``TRACE_FORMAT``  its document's ``format``
"""

from collections.abc import Iterable, Mapping
from typing import Any, Final, Literal, Self

from pydantic import ValidationError, model_validator

from tlcomm_core.errors import InputError
from tlcomm_core.records import RunRecords
from tlcomm_core.scenario.model import Scenario
from tlcomm_tools.figures import reduction
from tlcomm_tools.figures.elements import (
    AdditionalTime,
    Agreement,
    Course,
    Element,
    Ground,
    Meeting,
    Path,
    Profile,
    Series,
    Span,
)

__all__ = ["TRACE_FORMAT", "Trace"]

TRACE_FORMAT: Final = "tlcomm-trace/1"


class Trace(Element):
    """What is drawn of a run.

    Attributes:
        scenario: its name.
        method: of coordination.
        seed: of all that was random.
        end_s: simulated time at the end.
        period_s: T_c.
        duration_s: D_c.
        ground: the workspace.
        paths: each agent's way, in the order of the team.
        spans: what each agent did when.
        satisfied_s: when each agent's task was satisfied.
        missed_rounds: the windows in which the team wasn't connected for D_c.
        meetings: those that took place.
        additional_times: of the rounds.
        agreements: what team strategies cost.
        courses: how that came down, of the rounds for which it was followed.
        estimates: of the field, of each agent that has any.
        field: its true value ν(t); ``None`` if there is no field.
    """

    format: Literal["tlcomm-trace/1"] = TRACE_FORMAT
    scenario: str
    method: str
    seed: int
    end_s: float
    period_s: float
    duration_s: float
    ground: Ground
    paths: dict[str, Path]
    spans: dict[str, tuple[Span, ...]]
    satisfied_s: dict[str, tuple[float, ...]]
    missed_rounds: tuple[int, ...]
    meetings: tuple[Meeting, ...]
    additional_times: tuple[AdditionalTime, ...]
    agreements: tuple[Agreement, ...]
    courses: tuple[Course, ...]
    estimates: dict[str, Series]
    field: Profile | None

    @model_validator(mode="after")
    def _check(self) -> Self:
        team = tuple(self.paths)
        for name in ("spans", "satisfied_s"):
            if tuple(getattr(self, name)) != team:
                raise ValueError(f"{name} isn't of the agents {', '.join(team)}, in this order")
        strangers = self.estimates.keys() - self.paths.keys()
        strangers |= {name for own in self.meetings for name in own.places_m} - self.paths.keys()
        if strangers:
            raise ValueError(f"{', '.join(sorted(strangers))} has no path")
        return self

    @classmethod
    def from_records(
        cls,
        scenario: Scenario,
        method: str,
        records: RunRecords,
        result: Mapping[str, Any],
        courses: Iterable[Course] = (),
    ) -> Self:
        """Return what is drawn of a run.

        Args:
            scenario: what was run.
            method: of coordination.
            records: what happened.
            result: the run's result document.
            courses: how Φ came down in some rounds.
        """
        end_s: float = result["sim_s"]
        odometry = reduction.by_agent(scenario, records.odometry)
        tasks = reduction.by_agent(scenario, records.tasks)
        return cls(
            scenario=scenario.name,
            method=method,
            seed=result["seed"],
            end_s=end_s,
            period_s=scenario.communication.period_s,
            duration_s=scenario.communication.duration_s,
            ground=reduction.ground(scenario),
            paths={name: reduction.path(own) for name, own in odometry.items()},
            spans={name: reduction.spans(own, end_s) for name, own in tasks.items()},
            satisfied_s={name: reduction.satisfactions_s(own) for name, own in tasks.items()},
            missed_rounds=tuple(result["communication"]["missed_rounds"]),
            meetings=reduction.meetings(scenario, records, end_s),
            additional_times=reduction.additional_times(result["rounds"]),
            agreements=reduction.agreements(records),
            courses=tuple(courses),
            estimates={
                name: reduction.estimates(own)
                for name, own in reduction.by_agent(scenario, records.estimates).items()
                if own
            },
            field=reduction.field(scenario, end_s),
        )

    @classmethod
    def from_json(cls, text: str | bytes) -> Self:
        """Return the trace of a JSON document.

        Raises:
            InputError: the document isn't a trace; the message names the place.
        """
        try:
            return cls.model_validate_json(text)
        except ValidationError as error:
            first = error.errors()[0]
            place = ".".join(str(part) for part in first["loc"])
            raise InputError(f"trace: {place or 'document'}: {first['msg']}") from error

    def to_json(self) -> str:
        """Return the trace as one line of JSON."""
        return self.model_dump_json()
