"""What agents say while they plan a round, by the size of the team.

``RoundTraffic``     what was said of one round
``TrafficRow``       a team size's and solver's medians over some rounds
``listen``           the rounds of one scenario
``measure_traffic``  all rows, of random scenarios
``format_traffic``   a table of them

Messages and bytes are those that agents send, each once however many hear it, as they are counted
in ``result.json``: a run over ROS sends the same.
"""

import statistics
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import astuple, dataclass
from typing import Final

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.game.solver import BEST_RESPONSE, COALITION, Solver
from tlcomm_core.mission import Mission
from tlcomm_core.protocol.messages import BestResponse, Message, PlanOffer, Proposal, TeamMessage
from tlcomm_core.protocol.size import size_bytes
from tlcomm_core.records import RunRecords
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate
from tlcomm_core.units import seconds
from tlcomm_tools.instances import random_site
from tlcomm_tools.limit import time_limit_s
from tlcomm_tools.table import format_number, format_table

__all__ = [
    "SIZES",
    "RoundTraffic",
    "TrafficRow",
    "format_traffic",
    "listen",
    "measure_traffic",
]

SIZES: Final = (4, 8, 12, 16, 20)
"""The teams that the published figures are about."""


@dataclass(frozen=True, slots=True)
class RoundTraffic:
    """What was said of one round, at the meeting before it.

    Attributes:
        diameter: D, of the meeting graph: the exchanges of one minimum consensus; at least 1.
        exchanges: of all consensuses: that of proposals and each iteration's.
        messages: sent by an agent, in the mean.
        sent_bytes: the same in bytes.
        offer_bytes: of these, the share of plan offers.
        agreed_s: simulated time from the last arrival to the last agent's agreement.
    """

    diameter: float
    exchanges: float
    messages: float
    sent_bytes: float
    offer_bytes: float
    agreed_s: float


@dataclass(frozen=True, slots=True)
class TrafficRow:
    """A team size's and solver's medians.

    Attributes:
        agents: N.
        solver: its name.
        rounds: how many the medians are over.
        median: of each figure by itself.
    """

    agents: int
    solver: str
    rounds: int
    median: RoundTraffic


def measure_traffic(
    sizes: Iterable[int] = SIZES,
    solvers: Sequence[Solver] = (BEST_RESPONSE, COALITION),
    scenarios: int = 3,
    rounds: int = 3,
) -> Iterator[TrafficRow]:
    """Yield a row for each team size and solver.

    Args:
        sizes: team sizes N.
        solvers: of the rounds.
        scenarios: how many random scenarios of each size.
        rounds: how many rounds of each, from the first on.
    """
    for agents in sizes:
        sites = [random_site(agents, index) for index in range(scenarios)]
        for solver in solvers:
            heard = [own for site in sites for own in listen(site, rounds, solver)]
            yield TrafficRow(agents, solver.name, len(heard), _median(heard))


def listen(site: Site, rounds: int, solver: Solver) -> tuple[RoundTraffic, ...]:
    """Return what is said of the rounds 1 to ``rounds``; all of them are to be agreed.

    Raises:
        PlanningError: an agent's task has no plan.
        InfeasibleRoundError: the team has no admissible next meeting.

    Cost: a simulation of the rounds before the last.
    """
    said: list[TeamMessage] = []
    limit_s = time_limit_s(site.scenario, rounds - 1, None)
    left = simulate(Mission(site, 0, rounds - 1, limit_s, solver), on_message=said.append)
    return tuple(
        _round(
            [own for own in said if isinstance(own, Message) and own.round == number],
            len(site.scenario.agents),
            _agreed_s(left.records, number),
        )
        for number in range(1, rounds + 1)
    )


def _round(said: Sequence[Message], agents: int, agreed_s: float) -> RoundTraffic:
    exchanges = {
        (word.iteration, word.hop) for word in said if isinstance(word, Proposal | BestResponse)
    }
    lengths = [size_bytes(message) for message in said]
    offered = [size_bytes(message) for message in said if isinstance(message, PlanOffer)]
    return RoundTraffic(
        diameter=len({hop for _, hop in exchanges}),
        exchanges=len(exchanges),
        messages=len(said) / agents,
        sent_bytes=sum(lengths) / agents,
        offer_bytes=sum(offered) / agents,
        agreed_s=agreed_s,
    )


def _agreed_s(records: RunRecords, number: int) -> float:
    arrivals_ns = [
        record.stamp_ns
        for record in records.tasks
        if record.event.kind is TaskEventKind.MEETING_REACHED and record.event.round == number - 1
    ]
    agreed_ns = [own.stamp_ns for own in records.strategies if own.strategy.round == number]
    return seconds(max(agreed_ns) - max(arrivals_ns))


def _median(rounds: Iterable[RoundTraffic]) -> RoundTraffic:
    columns = zip(*map(astuple, rounds), strict=True)
    return RoundTraffic(*map(statistics.median, columns))


def format_traffic(rows: Iterable[TrafficRow]) -> str:
    """Return a table for a terminal of 80 columns."""
    cells = [
        (
            row.solver,
            str(row.agents),
            format_number(row.median.diameter, 0),
            format_number(row.median.exchanges, 0),
            format_number(row.median.messages),
            format_number(1e-3 * row.median.sent_bytes),
            format_number(1e-3 * row.median.offer_bytes),
            format_number(row.median.agreed_s, 3),
        )
        for row in rows
    ]
    header = ("solver", "N", "D", "exchanges", "messages", "kB", "offers/kB", "agreed/s")
    return (
        f"{format_table(header, cells)}\n\n"
        "  medians over rounds of random scenarios; messages and kB per agent and round\n"
        "  D          of the meeting graph: exchanges of one minimum consensus\n"
        "  exchanges  of all: the proposals' and each iteration's\n"
        "  offers     their share of the bytes\n"
        "  agreed     from the last arrival to the last agreement, in simulated time"
    )
