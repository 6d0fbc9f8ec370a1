"""How far agents' estimates are from the field.

``Deviation``          mean and largest of one agent's, or of a team's
``deviations``         of each agent that has an estimate
``deviation_of_team``  of them together
``SETTLED_PERIODS``    after how many periods the start doesn't tell any more

Agent i holds its estimate x_i(t) until the next one; its deviation is

    e_i(t) = |x_i(t) − ν(t)|

from its first estimate to the end of the run. Until the team has met, agents have nothing but what
they have read themselves, by any method: the largest e_i is also told from 2·T_c on, by when the
first window with a meeting to go to is over. As x_i is constant and ν linear between the changes
of either, so is x_i − ν: mean and maximum over time are exact.

Source: Section V-C of the paper, which shows e_i over time and tells the largest.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.field.field import Field
from tlcomm_core.records import EstimateRecord
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.units import seconds

__all__ = ["SETTLED_PERIODS", "Deviation", "deviation_of_team", "deviations"]

SETTLED_PERIODS: Final = 2
"""After how many T_c estimates have settled: the first window with a meeting to go to is over."""


@dataclass(frozen=True, slots=True)
class Deviation:
    """Of one agent, or of all of a team, in the field's unit.

    Attributes:
        mean: of e over time.
        most: the largest e.
        span_s: how long there was an estimate.
    """

    mean: float
    most: float
    span_s: float


def deviations(
    scenario: Scenario, estimates: Sequence[EstimateRecord], end_ns: int, begin_ns: int = 0
) -> dict[str, Deviation]:
    """Return each agent's deviation; without those that had no estimate before the end.

    Args:
        scenario: with the field; without one nobody deviates.
        estimates: of all agents, in order of time; those after the end don't count.
        end_ns: when the run ended.
        begin_ns: from when on deviations count.

    Cost: O(estimates · log of the field's points).
    """
    field = Field.of(scenario)
    if field is None or scenario.field is None or begin_ns >= end_ns:
        return {}
    knots_s = np.array([time_s for time_s, _ in scenario.field.profile])
    held: dict[str, list[tuple[float, float]]] = {name: [] for name in scenario.agents}
    for own in estimates:
        if own.stamp_ns < end_ns:
            held[own.agent].append((seconds(own.stamp_ns), own.value))
    return {
        name: _deviation(field, knots_s, np.array(own), seconds(begin_ns), seconds(end_ns))
        for name, own in held.items()
        if own
    }


def deviation_of_team(agents: Mapping[str, Deviation]) -> Deviation | None:
    """Return the mean over time and agents, and the largest of all; ``None`` without any agent."""
    if not agents:
        return None
    span_s = sum(own.span_s for own in agents.values())
    mean = sum(own.mean * own.span_s for own in agents.values()) / span_s
    return Deviation(mean, max(own.most for own in agents.values()), span_s)


def _deviation(
    field: Field,
    knots_s: NDArray[np.float64],
    held: NDArray[np.float64],
    begin_s: float,
    end_s: float,
) -> Deviation:
    """Return one agent's deviation.

    Args:
        field: ν.
        knots_s: where ν bends, float[K].
        held: times (s) and values of the estimates, float[E, 2], E ≥ 1, ascending.
        begin_s: from when on it counts, if there is an estimate.
        end_s: when the last one ends.
    """
    since_s = max(begin_s, held[0, 0])
    changes_s = np.concatenate((held[:, 0], knots_s))
    inside_s = changes_s[(changes_s > since_s) & (changes_s < end_s)]
    times_s = np.unique(np.concatenate((inside_s, [since_s, end_s])))
    # Of several estimates at one time the last counts.
    value = held[np.searchsorted(held[:, 0], times_s[:-1], side="right") - 1, 1]
    truth = field.value(times_s)
    first, last = value - truth[:-1], value - truth[1:]
    area = float((_mean_size(first, last) * np.diff(times_s)).sum())
    most = float(max(np.abs(first).max(), np.abs(last).max()))
    return Deviation(area / (end_s - since_s), most, float(end_s - since_s))


def _mean_size(first: NDArray[np.float64], last: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the mean of |e| while e goes linearly from ``first`` to ``last``.

    That is (|a| + |b|) / 2, and where the sign changes (a² + b²) / 2(|a| + |b|): two triangles.
    """
    sizes = np.abs(first) + np.abs(last)
    crosses = first * last < 0.0
    squares = first * first + last * last
    return np.where(crosses, squares / np.where(crosses, 2.0 * sizes, 1.0), 0.5 * sizes)
