"""Round problems as the team poses them.

``pose_round``  one round's problem
"""

from tlcomm_core.agent.member import team_of
from tlcomm_core.agent.rounds import MeetingRounds
from tlcomm_core.errors import InputError
from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.game.solver import DEFAULT, Solver
from tlcomm_core.mission import Mission
from tlcomm_core.protocol.messages import Message, PlanOffer
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_tools.limit import time_limit_s

__all__ = ["pose_round"]


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
    heard: list[PlanOffer] = []

    def listen(message: Message) -> None:
        if isinstance(message, PlanOffer) and message.round == number:
            heard.append(message)

    limit_s = time_limit_s(site.scenario, number - 1, None)
    simulate(Mission(site, seed, number - 1, limit_s, solver), on_message=listen)
    offers = {offer.agent: offer for message in heard for offer in message.offers}
    absent = [name for name in site.scenario.agents if name not in offers]
    if absent:
        raise InputError(
            f"round {number} is never planned: the meeting before it lacks {', '.join(absent)}"
        )
    team = team_of(site)
    arrived_s = max(offer.arrival_s for offer in offers.values())
    departure_s = max(arrived_s, team.opens_s(number - 1)) + team.duration_s
    atlas = Atlas(site.grid, site.region_discs)
    rounds = MeetingRounds(atlas, team, segment_allowance_s=0.0)
    return rounds.problem(number, departure_s, [offers[name] for name in sorted(offers)])
