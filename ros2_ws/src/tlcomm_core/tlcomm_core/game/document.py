"""The round problem and its solution as a JSON document, ``tlcomm-round/1``.

``ROUND_FORMAT``     the document's ``format``
``round_document``   problem and solution as JSON-ready values
``profile_document`` one team strategy of it
``solved_document``  what a solver found
``parse_round``      the problem of a document
"""

import math
from collections.abc import Mapping
from typing import Annotated, Final, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import BaseModel, ConfigDict, Field, ValidationError

from tlcomm_core.errors import InputError
from tlcomm_core.game.algorithm import Solution
from tlcomm_core.game.links import Links
from tlcomm_core.game.potential import potential
from tlcomm_core.game.problem import Candidates, Profile, RoundProblem
from tlcomm_core.game.rules import Rules
from tlcomm_core.game.solver import Solved

__all__ = ["ROUND_FORMAT", "parse_round", "profile_document", "round_document", "solved_document"]

ROUND_FORMAT: Final = "tlcomm-round/1"

# How much of an offending value an error quotes.
_SHORT: Final = 60


def round_document(problem: RoundProblem, solution: Solution) -> dict[str, object]:
    """Return a round's problem and solution, ready for ``json.dumps``.

    Inadmissible entries become None. ``candidates`` is a list in the order of ``agents``, as
    ``location`` and ``candidate`` of the solutions are. ``blind`` lists the pairs of locations that
    aren't linked although they are in range.
    """
    return {
        "format": ROUND_FORMAT,
        "round": problem.round,
        "window": list(problem.window_s),
        "range": problem.range_m,
        "agents": list(problem.agents),
        "locations": problem.locations_m.tolist(),
        "blind": [list(pair) for pair in problem.links.blind_pairs],
        "separation": problem.rules.separation_m,
        "resilience": problem.rules.resilience,
        "candidates": [
            {
                "task_index": own.task_index.tolist(),
                "arrival": _with_nulls(own.arrival_s),
                "extra": _with_nulls(own.extra_s),
            }
            for own in problem.candidates
        ],
        "initial": profile_document(problem, solution.initial),
        "nash": profile_document(problem, solution.nash),
    }


def profile_document(problem: RoundProblem, profile: Profile) -> dict[str, object]:
    """Return a team strategy as the document holds it, whichever solver found it."""
    opens_s, _ = problem.window_s
    return {
        "location": list(profile.location),
        "candidate": list(profile.candidate),
        "potential": potential(problem.strategies(profile), opens_s),
    }


def solved_document(problem: RoundProblem, solved: Solved) -> dict[str, object]:
    """Return what a team found with a solver, its bound None where nothing is proven."""
    bound_s = solved.bound_s if math.isfinite(solved.bound_s) else None
    return profile_document(problem, solved.solution.nash) | {"bound": bound_s}


def parse_round(document: Mapping[str, object]) -> RoundProblem:
    """Return the problem of a document; members that it doesn't need are ignored.

    Raises:
        InputError: the document isn't a round problem; the message names the place.
    """
    try:
        model = _Document.model_validate(document)
    except ValidationError as error:
        first = error.errors()[0]
        place = ".".join(str(part) for part in first["loc"])
        raise InputError(
            f"round problem: {place}: {first['msg']}, not {_short(first['input'])}"
        ) from error
    _check_names(model)
    return RoundProblem(
        round=model.round,
        window_s=model.window,
        links=Links.without(
            np.array(model.locations, dtype=np.float64).reshape(-1, 2), model.range, model.blind
        ),
        candidates=tuple(
            _parse_table(agent, table, len(model.locations))
            for agent, table in zip(model.agents, model.candidates, strict=True)
        ),
        rules=Rules(model.separation, model.resilience),
    )


_TimeTable = list[list[float | None]]


class _Model(BaseModel):
    model_config = ConfigDict(strict=True, allow_inf_nan=False)


class _TableModel(_Model):
    task_index: list[Annotated[int, Field(ge=0)]]
    arrival: _TimeTable
    extra: _TimeTable


class _Document(_Model):
    # Lists of JSON are no tuples, hence the fields that aren't strict.
    format: Literal["tlcomm-round/1"]
    round: Annotated[int, Field(ge=0)]
    window: Annotated[tuple[float, float], Field(strict=False)]
    range: Annotated[float, Field(gt=0.0)]
    agents: Annotated[list[str], Field(min_length=1)]
    locations: list[Annotated[tuple[float, float], Field(strict=False)]]
    candidates: list[_TableModel]
    # Documents from before there were such rules lack them.
    blind: list[Annotated[tuple[int, int], Field(strict=False)]] = []
    separation: Annotated[float, Field(ge=0.0)] = 0.0
    resilience: Annotated[int, Field(ge=0, le=1)] = 0


def _check_names(model: _Document) -> None:
    if model.window[0] >= model.window[1]:
        raise InputError(
            f"round problem: window: expected a start before the end, not {model.window!r}"
        )
    places = len(model.locations)
    for pair in model.blind:
        if not 0 <= pair[0] < pair[1] < places:
            raise InputError(
                f"round problem: blind: expected two of {places} places, the lower first, not "
                f"{pair!r}"
            )
    if model.agents != sorted(set(model.agents)):
        raise InputError(
            f"round problem: agents: expected distinct names, sorted, not {model.agents!r}"
        )
    if len(model.candidates) != len(model.agents):
        raise InputError(
            f"round problem: candidates: expected one table for each of {len(model.agents)} "
            f"agents, not {len(model.candidates)!r}"
        )


def _parse_table(agent: str, table: _TableModel, places: int) -> Candidates:
    indices = table.task_index
    if indices != sorted(set(indices)):
        raise InputError(
            f"round problem: candidates of {agent}: task_index isn't ascending: {indices!r}"
        )
    times = {"arrival": table.arrival, "extra": table.extra}
    for name, rows in times.items():
        widths = [len(row) for row in rows]
        if widths != [places] * len(indices):
            raise InputError(
                f"round problem: candidates of {agent}: {name}: expected {len(indices)} rows of "
                f"{places} places, not rows of {widths!r}"
            )
    arrival_s, extra_s = (_with_inf(rows, places) for rows in times.values())
    if (np.isfinite(arrival_s) != np.isfinite(extra_s)).any():
        raise InputError(
            f"round problem: candidates of {agent}: arrival and extra differ in their nulls"
        )
    return Candidates(agent, np.array(indices, dtype=np.int64), arrival_s, extra_s)


def _with_nulls(times_s: NDArray[np.float64]) -> list[list[float | None]]:
    rows: list[list[float]] = times_s.tolist()
    return [[value if value < math.inf else None for value in row] for row in rows]


def _with_inf(rows: _TimeTable, places: int) -> NDArray[np.float64]:
    values = [[np.inf if value is None else value for value in row] for row in rows]
    return np.array(values, dtype=np.float64).reshape(-1, places)


def _short(value: object) -> str:
    text = repr(value)
    return text if len(text) <= _SHORT else f"{text[:_SHORT]}…"
