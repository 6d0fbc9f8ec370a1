"""Round problems as the team poses them.

``pose_round``        one round's problem
``pose_rounds``       those of the first rounds
``pose_first_round``  that of the first round, without a meeting
"""

from collections import defaultdict
from collections.abc import Iterable, Mapping

from tlcomm_core.agent.charts import Charts
from tlcomm_core.agent.controller import Pacing
from tlcomm_core.agent.member import create, team_of
from tlcomm_core.agent.rounds import MeetingRounds
from tlcomm_core.errors import InputError
from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.game.solver import DEFAULT, Solver
from tlcomm_core.mission import Mission
from tlcomm_core.protocol.actions import SendMessage
from tlcomm_core.protocol.messages import PlanOffer, TeamMessage
from tlcomm_core.scenario.site import Site, later_grids
from tlcomm_core.simulation import simulate
from tlcomm_core.units import nanoseconds
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_tools.limit import time_limit_s

__all__ = ["pose_first_round", "pose_round", "pose_rounds"]


def pose_round(site: Site, number: int, seed: int, solver: Solver = DEFAULT) -> RoundProblem:
    """Return the problem of a round from what the agents offer at the meeting before it.

    Args:
        site: the scenario.
        number: the round, from 1 on.
        seed: of all that is random until then.
        solver: of the rounds until then.

    Raises:
        InputError: the team doesn't get so far.
        PlanningError: an agent's task has no plan.

    Cost: a simulation of the rounds before it.
    """
    return _Poser(site).problem(number, _offers(site, number, seed, solver)[number])


def pose_rounds(
    site: Site, count: int, seed: int, solver: Solver = DEFAULT
) -> tuple[RoundProblem, ...]:
    """Return the problems of the rounds 1 to ``count``; the rest is as for ``pose_round``."""
    offers = _offers(site, count, seed, solver)
    poser = _Poser(site)
    return tuple(poser.problem(number, offers[number]) for number in range(1, count + 1))


def pose_first_round(site: Site) -> RoundProblem:
    """Return the problem of round 1 from what the agents offer where they start.

    It is what ``pose_round`` returns, and takes less by the time that a meeting takes in
    simulation: many agents need minutes, as each poses the problem.

    Raises:
        PlanningError: an agent's task has no plan.
    """
    poser = _Poser(site)
    offers: dict[str, MemberOffer] = {}
    for name in site.scenario.agents:
        member = create(name, site, Pacing.EVENT, poser.atlas)
        member.see_odometry(0, site.start_of(name), 0.0, 0.0)
        said = (action.message for action in member.step(0) if isinstance(action, SendMessage))
        offers |= _offered(said)[1]
    return poser.problem(1, offers)


class _Poser:
    """Poses a scenario's problems."""

    def __init__(self, site: Site) -> None:
        self.atlas = Atlas(site.grid, site.region_discs)
        self._site = site
        self._team = team_of(site)
        charts = Charts(self.atlas)
        workspace = site.scenario.workspace
        for change, grid in zip(workspace.changes, later_grids(workspace), strict=True):
            charts.take(nanoseconds(change.at_s), grid.free)
        self._rounds = MeetingRounds(charts, self._team, segment_allowance_s=0.0)

    def problem(self, number: int, offers: Mapping[str, MemberOffer]) -> RoundProblem:
        """Return the problem of a round from the offers for it."""
        absent = [name for name in self._site.scenario.agents if name not in offers]
        if absent:
            raise InputError(
                f"round {number} is never planned: the meeting before it lacks {', '.join(absent)}"
            )
        arrived_s = max(offer.arrival_s for offer in offers.values())
        departure_s = max(arrived_s, self._team.opens_s(number - 1)) + self._team.duration_s
        in_order = [offers[name] for name in sorted(offers)]
        return self._rounds.problem(number, departure_s, in_order)


def _offers(
    site: Site, last: int, seed: int, solver: Solver
) -> Mapping[int, dict[str, MemberOffer]]:
    """Return what is offered for each round up to the last, by simulating those before."""
    heard: list[TeamMessage] = []
    limit_s = time_limit_s(site.scenario, last - 1, None)
    simulate(Mission(site, seed, last - 1, limit_s, solver), on_message=heard.append)
    return _offered(heard)


def _offered(messages: Iterable[TeamMessage]) -> Mapping[int, dict[str, MemberOffer]]:
    offers: defaultdict[int, dict[str, MemberOffer]] = defaultdict(dict)
    for message in messages:
        if isinstance(message, PlanOffer):
            offers[message.round] |= {offer.agent: offer for offer in message.offers}
    return offers
