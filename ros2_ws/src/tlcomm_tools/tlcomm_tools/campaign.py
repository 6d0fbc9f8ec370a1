"""Meetings rehearsed over bad radio, many times: how long agreement takes, and how often too long.

``Campaign``     what to rehearse
``Rehearsed``    what came of one meeting
``rehearse``     all of a campaign's meetings, one after the other
``LATENCY_S``    how long a message takes at least
``MOST_AGENTS``  how large a team may be

The negotiations and the radio's ``Channel`` are those of real runs; vehicles aren't needed, and
computing takes no time. Each meeting is a random one: agents at places that are connected, planning
a random round. All of it follows from its seed.
"""

import heapq
import itertools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.agent.channel import Channel
from tlcomm_core.errors import InfeasibleRoundError
from tlcomm_core.game.algorithm import improve
from tlcomm_core.game.initial import initial_profile
from tlcomm_core.game.offer import MemberOffer, PlannedStop
from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.game.sample import sample_problem
from tlcomm_core.game.solver import BEST_RESPONSE, Proposed, Solver
from tlcomm_core.protocol.actions import SendMessage
from tlcomm_core.protocol.messages import Message
from tlcomm_core.protocol.negotiation import Negotiation
from tlcomm_core.protocol.team import Team
from tlcomm_core.scenario.model import Radio
from tlcomm_core.units import nanoseconds, seconds

__all__ = ["LATENCY_S", "MOST_AGENTS", "Campaign", "Rehearsed", "rehearse"]

LATENCY_S: Final = 0.005
MOST_AGENTS: Final = 30
"""Of larger teams random rounds hardly ever have a solution."""

_PERIOD_S: Final = 60.0
_RANGE_M: Final = 1.0
_PLANNED_M: Final = 0.96
_NEXT_M: Final = (0.5, 0.9)
_LATEST_S: Final = 10.0
_TASKS: Final = 4
_LATTICE: Final = (8, 8)
_STOPS: Final = tuple(PlannedStop(index, 0.0, 0.0, 0.0, 10.0 * index) for index in range(2))

Place = tuple[float, float]


@dataclass(frozen=True, slots=True)
class Campaign:
    """What to rehearse.

    Attributes:
        agents: N.
        meetings: how many.
        radio: how bad it is.
        duration_s: D_c.
        proposes: whether agents propose team strategies, as most solvers do; here all the same
            one. Otherwise best responses alone lead to it.
        seed: of the first meeting; each further one has the next.
    """

    agents: int
    meetings: int
    radio: Radio
    duration_s: float
    proposes: bool
    seed: int


@dataclass(frozen=True, slots=True)
class Rehearsed:
    """What came of one meeting.

    Attributes:
        agreed_s: from the last arrival to the last agent's agreement; inf if some agent had to
            leave before it.
        messages: how many an agent sent, in the mean.
    """

    agreed_s: float
    messages: float


def rehearse(campaign: Campaign) -> Iterator[Rehearsed]:
    """Yield what comes of each meeting."""
    for seed in range(campaign.seed, campaign.seed + campaign.meetings):
        yield _Meeting(campaign, seed).run()


@dataclass(frozen=True, slots=True)
class _OneRound:
    """``Rounds`` that pose one problem, whatever is offered."""

    posed: RoundProblem

    def is_sound(self, offer: MemberOffer) -> bool:
        """Return that it is: all offers are made here."""
        return offer.agent in self.posed.agents

    def sightings(self, offers: Sequence[MemberOffer]) -> tuple[NDArray[np.bool_], ...]:
        """Return that none of these has to see another."""
        assert offers
        return ()

    def problem(
        self, round_: int, departure_s: float, offers: Sequence[MemberOffer]
    ) -> RoundProblem:
        """Return the problem."""
        assert round_ == self.posed.round
        assert len(offers) == len(self.posed.agents)
        assert departure_s < self.posed.window_s[1]
        return self.posed


class _Meeting:
    """A meeting: who is there, who hears whom, and what is on the air."""

    def __init__(self, campaign: Campaign, seed: int) -> None:
        rng = np.random.default_rng(seed)
        problem = _feasible(rng, campaign.agents)
        opens_s = (problem.round - 1) * _PERIOD_S
        places_m = _connected_places_m(rng, campaign.agents)
        arrivals_s = rng.uniform(opens_s, opens_s + _LATEST_S, campaign.agents).tolist()
        team = Team(
            members=frozenset(problem.agents),
            planned_range_m=_PLANNED_M,
            period_s=_PERIOD_S,
            duration_s=campaign.duration_s,
            solver=_proposing(problem) if campaign.proposes else BEST_RESPONSE,
        )
        self._begins_s = max(arrivals_s)
        self._ends_s = self._begins_s + campaign.duration_s
        self._places_m = dict(zip(problem.agents, places_m, strict=True))
        self._channels = {
            name: Channel(campaign.radio, _RANGE_M, seed, name) for name in problem.agents
        }
        self._present: dict[str, Negotiation] = {}
        self._order = itertools.count()
        self._due: list[tuple[float, int, str, Negotiation | Message]] = []
        self._said = 0
        for name, arrival_s in zip(problem.agents, arrivals_s, strict=True):
            offer = MemberOffer(name, arrival_s, *self._places_m[name], 0.0, 1.0, 1.5, _STOPS)
            arriving = Negotiation(offer, problem.round, team, _OneRound(problem))
            self._post(arrival_s, name, arriving)

    def run(self) -> Rehearsed:
        """Let it take place until all have agreed, or it is over."""
        now_s = -math.inf
        while not self._is_agreed and now_s <= self._ends_s:
            now_s = self._step()
        agreed_s = now_s - self._begins_s if self._is_agreed else math.inf
        return Rehearsed(agreed_s, self._said / len(self._places_m))

    @property
    def _is_agreed(self) -> bool:
        all_here = len(self._present) == len(self._places_m)
        return all_here and all(own.agreed is not None for own in self._present.values())

    def _step(self) -> float:
        """Jump to the next instant; let everybody hear, and then say, what is due."""
        needs_s = {name: own.next_need_s for name, own in self._present.items()}
        now_s = min([*needs_s.values(), *(entry[0] for entry in self._due[:1])])
        awake = {name for name, need_s in needs_s.items() if need_s <= now_s}
        while self._due and self._due[0][0] <= now_s:
            _, _, name, what = heapq.heappop(self._due)
            if isinstance(what, Negotiation):
                self._present[name] = what
            elif name in self._present:
                self._present[name].hear(what)
            awake.add(name)
        for name in sorted(awake & self._present.keys()):
            for action in self._present[name].proceed(now_s):
                if isinstance(action, SendMessage):
                    self._send(name, action.message, now_s)
        return now_s

    def _send(self, sender: str, message: Message, now_s: float) -> None:
        self._said += 1
        for name, place_m in self._places_m.items():
            distance_m = math.dist(self._places_m[sender], place_m)
            if name != sender and distance_m <= _RANGE_M:
                passage = self._channels[name].carry(message, nanoseconds(now_s), distance_m)
                for delay_ns in passage.delays_ns:
                    self._post(now_s + LATENCY_S + seconds(delay_ns), name, message)

    def _post(self, time_s: float, name: str, what: Negotiation | Message) -> None:
        heapq.heappush(self._due, (time_s, next(self._order), name, what))


def _feasible(rng: np.random.Generator, agents: int) -> RoundProblem:
    """Return a random round that has a solution."""
    while True:
        problem = sample_problem(rng, agents, _TASKS, *_LATTICE)
        try:
            initial_profile(problem)
        except InfeasibleRoundError:
            continue
        return problem


def _connected_places_m(rng: np.random.Generator, agents: int) -> list[Place]:
    """Return random places, each near one of those before it."""
    places_m: list[Place] = [(0.0, 0.0)]
    while len(places_m) < agents:
        x_m, y_m = places_m[rng.integers(len(places_m))]
        angle_rad, distance_m = rng.uniform(0.0, math.tau), rng.uniform(*_NEXT_M)
        places_m.append(
            (x_m + distance_m * math.cos(angle_rad), y_m + distance_m * math.sin(angle_rad))
        )
    return places_m


def _proposing(problem: RoundProblem) -> Solver:
    """Return a solver with which all agents propose what best responses lead to."""
    proposed = Proposed(improve(problem, initial_profile(problem)).nash, -math.inf)
    return Solver("equilibrium", lambda _problem, _initial, _searcher: proposed)
