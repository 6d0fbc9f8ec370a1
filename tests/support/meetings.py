"""Meetings to plan at: places in every shape, offers, and problems for them.

``SHAPES``         shapes of a meeting graph
``Meeting``        all that a negotiation is made of
``places``         places of a given shape
``make_team``      a team of agents by number
``make_offers``    what agents at given places offer
``SampleRounds``   ``Rounds`` that pose one sample problem
``sample_meeting`` a meeting that plans a random feasible round
``plant_meeting``  a meeting on a real map, with real offers
``reference``      what a team must agree on
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.agent.charts import Charts
from tlcomm_core.agent.rounds import MeetingRounds
from tlcomm_core.errors import InfeasibleRoundError
from tlcomm_core.game.initial import initial_profile
from tlcomm_core.game.offer import MemberOffer, PlannedStop
from tlcomm_core.game.potential import evaluate
from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.game.sample import sample_problem
from tlcomm_core.game.solver import solve_with
from tlcomm_core.game.strategy import TeamStrategy
from tlcomm_core.protocol.team import Team
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.travel import Motion, TravelTimes

__all__ = [
    "SHAPES",
    "Meeting",
    "SampleRounds",
    "make_offers",
    "make_team",
    "places",
    "plant_meeting",
    "reference",
    "sample_meeting",
]

_PLANNED_M = 0.96
_SPACING_M = 0.9

SHAPES = ("line", "star", "ring", "clique", "random")

Place = tuple[float, float]


@dataclass(frozen=True, slots=True)
class SampleRounds:
    """Poses one problem, whatever is offered."""

    problem_: RoundProblem

    def sightings(self, offers: Sequence[MemberOffer]) -> tuple[NDArray[np.bool_], ...]:
        """Return that nobody has to see another."""
        assert offers
        return ()

    def is_sound(self, offer: MemberOffer) -> bool:
        """Return whether the offer has two stops and a place, as a real one must."""
        return len(offer.stops) >= 2 and math.isfinite(offer.x_m) and math.isfinite(offer.y_m)

    def problem(
        self, round_: int, departure_s: float, offers: Sequence[MemberOffer]
    ) -> RoundProblem:
        """Return the problem, for the team and the round that it was made for."""
        assert round_ == self.problem_.round, departure_s
        assert tuple(offer.agent for offer in offers) == self.problem_.agents
        return self.problem_


@dataclass(frozen=True, slots=True)
class Meeting:
    """All that a negotiation is made of."""

    offers: tuple[MemberOffer, ...]
    round: int
    team: Team
    rounds: SampleRounds | MeetingRounds
    range_m: float = 1.0

    @property
    def problem(self) -> RoundProblem:
        """The problem that the complete offers pose."""
        opens_s = self.team.opens_s(self.round - 1)
        begins_s = max(opens_s, *(offer.arrival_s for offer in self.offers))
        return self.rounds.problem(self.round, begins_s + self.team.duration_s, self.offers)


def places(shape: str, count: int, rng: np.random.Generator) -> tuple[Place, ...]:
    """Return places in one of ``SHAPES``, connected within 0.9 m and no less."""
    match shape:
        case "line":
            return tuple((index * _SPACING_M, 0.0) for index in range(count))
        case "star":
            # At most five arms, so that their first agents don't hear each other.
            return ((0.0, 0.0), *(_on_arm(index) for index in range(count - 1)))
        case "ring":
            radius_m = _SPACING_M / (2.0 * math.sin(math.pi / count)) if count > 2 else 0.45
            angles = [math.tau * index / count for index in range(count)]
            return tuple((radius_m * math.cos(a), radius_m * math.sin(a)) for a in angles)
        case "clique":
            return tuple((0.01 * index, 0.0) for index in range(count))
        case _:
            return _random_places(count, rng)


def _on_arm(index: int) -> Place:
    angle, distance_m = math.tau * (index % 5) / 5, _SPACING_M * (1 + index // 5)
    return distance_m * math.cos(angle), distance_m * math.sin(angle)


def _random_places(count: int, rng: np.random.Generator) -> tuple[Place, ...]:
    """Put each agent near one that is placed; some pairs end between planned and real range."""
    chosen: list[Place] = [(0.0, 0.0)]
    while len(chosen) < count:
        x_m, y_m = chosen[rng.integers(len(chosen))]
        angle, distance_m = rng.uniform(0.0, math.tau), rng.uniform(0.5, _SPACING_M)
        chosen.append((x_m + distance_m * math.cos(angle), y_m + distance_m * math.sin(angle)))
    return tuple(chosen)


def make_team(
    count: int,
    planned_range_m: float = _PLANNED_M,
    max_iterations: int = 1000,
) -> Team:
    """Return a team of ``agent_00``, ``agent_01``, …."""
    return Team(
        members=frozenset(f"agent_{index:02d}" for index in range(count)),
        planned_range_m=planned_range_m,
        period_s=60.0,
        duration_s=5.0,
        max_iterations=max_iterations,
    )


def make_offers(at_m: Sequence[Place], arrivals_s: Sequence[float]) -> tuple[MemberOffer, ...]:
    """Return an offer for each place and time of arrival."""
    stops = tuple(PlannedStop(index, 0.0, 0.0, 0.0, 10.0 * index) for index in range(2))
    return tuple(
        MemberOffer(f"agent_{index:02d}", arrival_s, x_m, y_m, 0.0, 1.0, 1.5, stops)
        for index, ((x_m, y_m), arrival_s) in enumerate(zip(at_m, arrivals_s, strict=True))
    )


def _arrivals_s(
    count: int, opens_s: float, spread_s: float, rng: np.random.Generator
) -> list[float]:
    """Return times around a window's opening: some before it, most after."""
    return [opens_s + float(rng.uniform(-0.2 * spread_s, spread_s)) for _ in range(count)]


def sample_meeting(
    shape: str,
    count: int,
    seed: int,
    spread_s: float = 10.0,
    tasks: int = 6,
    max_iterations: int = 1000,
) -> Meeting:
    """Return a meeting at random times that plans a random feasible round."""
    rng = np.random.default_rng(seed)
    problem = _feasible_problem(rng, count, tasks)
    arrivals = _arrivals_s(count, 60.0 * (problem.round - 1), spread_s, rng)
    offers = make_offers(places(shape, count, rng), arrivals)
    return Meeting(
        offers,
        problem.round,
        make_team(count, max_iterations=max_iterations),
        SampleRounds(problem),
    )


def _feasible_problem(rng: np.random.Generator, count: int, tasks: int) -> RoundProblem:
    while True:
        problem = sample_problem(rng, count, tasks, 8, 8)
        try:
            initial_profile(problem)
        except InfeasibleRoundError:
            continue
        return problem


@cache
def _plant_travel() -> TravelTimes:
    """Return the travel times of a room of 6 m × 6 m with a wall in it."""
    return TravelTimes(Grid((6.0, 6.0), 0.5, [(2.0, 1.0, 2.5, 4.0)]), Motion(1.0, 1.5))


def plant_meeting(count: int, seed: int) -> Meeting:
    """Return a meeting on a real map: agents along a row of cells, each with a random plan."""
    rng = np.random.default_rng(seed)
    travel = _plant_travel()
    team = make_team(count, planned_range_m=0.56)
    row = travel.grid.locations_m[-12:]
    offers = tuple(
        replace(offer, stops=_random_stops(travel, rng))
        for offer in make_offers(
            [tuple(place) for place in row[:count].tolist()], _arrivals_s(count, 60.0, 10.0, rng)
        )
    )
    return Meeting(offers, 2, team, MeetingRounds(Charts(Atlas(travel.grid)), team, 0.0), 0.6)


def _random_stops(travel: TravelTimes, rng: np.random.Generator) -> tuple[PlannedStop, ...]:
    finish_s, stops = 0.0, []
    for index in range(8):
        x_m, y_m = travel.grid.locations_m[rng.integers(len(travel.grid))].tolist()
        finish_s += rng.uniform(6.0, 16.0)
        stops.append(PlannedStop(index, x_m, y_m, 0.0, finish_s))
    return tuple(stops)


def reference(meeting: Meeting) -> TeamStrategy:
    """Return what the team's solver finds in one place."""
    problem = meeting.problem
    solved = solve_with(meeting.team.solver, problem)
    opens_s, _ = problem.window_s
    return evaluate(
        problem.round,
        problem.strategies(solved.solution.nash),
        opens_s,
        solved.solution.iterations,
        solved.initial_potential_s,
        solved.bound_s if math.isfinite(solved.bound_s) else None,
    )
