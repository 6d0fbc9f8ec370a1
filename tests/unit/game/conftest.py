"""Small round problems by hand."""

from collections.abc import Callable, Sequence

import numpy as np
import pytest

from tlcomm_core.game.links import Links
from tlcomm_core.game.problem import Candidates, RoundProblem

Entry = tuple[float, float]
MakeProblem = Callable[..., RoundProblem]


@pytest.fixture
def make_problem() -> MakeProblem:
    """Return a maker of problems with window [60, 120) s from (arrival, extra) per agent, h, z."""

    def make(
        locations_m: Sequence[Entry],
        range_m: float,
        **tables: Sequence[Sequence[Entry | None]],
    ) -> RoundProblem:
        return RoundProblem(
            round=1,
            window_s=(60.0, 120.0),
            links=Links(np.array(locations_m, dtype=np.float64).reshape(-1, 2), range_m),
            candidates=tuple(
                table_of(agent, rows, len(locations_m)) for agent, rows in tables.items()
            ),
        )

    return make


def table_of(agent: str, rows: Sequence[Sequence[Entry | None]], places: int) -> Candidates:
    """Return an agent's tables; row h stands for task 7 + h."""
    entries = [entry or (np.inf, np.inf) for row in rows for entry in row]
    values = np.array(entries, dtype=np.float64).reshape(len(rows), places, 2)
    return Candidates(agent, np.arange(len(rows)) + 7, values[..., 0], values[..., 1])
