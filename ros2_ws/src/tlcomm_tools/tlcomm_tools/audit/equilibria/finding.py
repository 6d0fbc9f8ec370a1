"""Whether anybody could have lowered the cost of a meeting alone, by the plans laid open.

``LATE_S``              what agents reckon for late controllers
``EquilibriumFinding``  what was found
``audit_equilibria``    looks it up
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.game.offer import MemberOffer
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.method import Method
from tlcomm_core.pace import Pace
from tlcomm_core.scenario.model import Scenario
from tlcomm_tools.audit.equilibria.candidates import Candidates, Ground, grounds_of
from tlcomm_tools.audit.equilibria.rounds import AgreedRound, agreed_rounds
from tlcomm_tools.audit.evidence import Evidence

__all__ = ["LATE_S", "EquilibriumFinding", "audit_equilibria"]

# Rounding of sums of times.
_SLACK_S: Final = 1e-6
# As near as this to a cell's middle is in it.
_SAME_M: Final = 1e-6
_SPEED_SLACK: Final = 1e-9
LATE_S: Final = 2.0 * 1.2 * 0.05
"""What an agent that runs freely reckons for a turn and a straight: each 1.2 periods of 50 ms."""

_MOST_STOPS: Final = 256
_MOST_REASONS: Final = 5
# A search that has come so far may have ended before nobody gained any more.
_MOST_MOVES: Final = 998


@dataclass(frozen=True, slots=True)
class EquilibriumFinding:
    """What was found.

    Attributes:
        strategies: how many team strategies are held.
        judged: how many of these it could be told of.
        lacking: of the others, why it couldn't, a line each.
        violations: one line each.
    """

    strategies: int
    judged: int
    lacking: tuple[str, ...]
    violations: tuple[str, ...]

    @property
    def unavailable(self) -> tuple[str, ...]:
        """Why it couldn't be told of some: the first few of many reasons."""
        first, more = self.lacking[:_MOST_REASONS], len(self.lacking) - _MOST_REASONS
        return (*first, f"and {more} more such strategies") if more > 0 else first

    def document(self) -> dict[str, int]:
        """Return it ready for ``json.dumps``; the lines are among those of all checks."""
        return {"strategies": self.strategies, "judged": self.judged}


def audit_equilibria(
    method: Method, evidence: Evidence, pace: Pace | None
) -> EquilibriumFinding | None:
    """Say who could have gained alone, and whose times aren't those of its plan.

    All solvers end with best responses over all places, until nobody gains: so whatever is agreed
    on, by any method whose agents choose when to meet, is a Nash equilibrium.

    Args:
        method: of coordination.
        evidence: of the run.
        pace: how time went on, which agents reckon with; ``None`` if that isn't known.

    Returns:
        What was found; ``None`` if the method leaves no choice.

    Source: Definition 2 of the paper, with u_i = δ_i + N·t_c − t_i.
    Cost: a search over cells and headings for each pose and each place that plans lead to, and
        O(H·Z) for each agent of each round.
    """
    if not method.has_meetings:
        return None
    late_s = math.nan if pace is None else 0.0 if pace.is_lockstep else LATE_S
    judge = _Judge(evidence.scenario, method, grounds_of(evidence.scenario, late_s))
    lacking: list[str] = []
    violations = list(_silent(evidence))
    judged = 0
    for agreed in agreed_rounds(method, evidence):
        obstacle = _lacking_at_all(evidence, pace) or judge.obstacle(agreed)
        if obstacle or isinstance(agreed, str):
            lacking.append(obstacle)
        else:
            judged += 1
            violations += judge.violations(agreed)
    count = judged + len(lacking)
    return EquilibriumFinding(count, judged, tuple(dict.fromkeys(lacking)), tuple(violations))


def _lacking_at_all(evidence: Evidence, pace: Pace | None) -> str:
    """Return what keeps one from judging any round, or ""."""
    if not evidence.records.offers:
        return "what agents planned isn't recorded"
    return "at which pace the run went isn't recorded" if pace is None else ""


def _silent(evidence: Evidence) -> Iterator[str]:
    """Say whose plans aren't recorded though others' are."""
    offering = {own.agent for own in evidence.records.offers}
    agreeing = {own.agent for own in evidence.records.strategies}
    if offering:
        yield from (f"{own}: no plan offers recorded" for own in sorted(agreeing - offering))


class _Judge:
    """Judges one round after the other."""

    def __init__(self, scenario: Scenario, method: Method, grounds: Mapping[int, Ground]) -> None:
        self._scenario = scenario
        self._keeps_places = not method.chooses_places
        self._grounds = grounds

    def obstacle(self, agreed: AgreedRound | str) -> str:
        """Return what keeps one from judging a round, or ""."""
        if isinstance(agreed, str):
            return agreed
        number, moves = agreed.held.round, agreed.held.iteration
        if agreed.map_ns not in self._grounds:
            from_s = agreed.map_ns * 1e-9
            return f"round {number}: the scenario has no map from {from_s:.3f} s on"
        if moves >= _MOST_MOVES:
            return f"round {number}: after {moves} moves the search may not have ended by itself"
        return ""

    def violations(self, agreed: AgreedRound) -> Iterator[str]:
        """Yield what is wrong with a round, a line each."""
        name = f"round {agreed.held.round}"
        flaws = [
            f"{name}: {offer.agent} {flaw}"
            for offer in agreed.offers
            if (flaw := _flaw(self._scenario, offer))
        ]
        yield from flaws
        if flaws:
            return
        ground, held = self._grounds[agreed.map_ns], agreed.held
        places = [ground.cells.at(own.x_m, own.y_m) for own in held.strategies]
        found = list(zip(held.strategies, places, strict=True))
        nowhere = [own.agent for own, place in found if not _is_middle(ground, own, place)]
        yield from (f"{name}: {agent} meets in the middle of no free cell" for agent in nowhere)
        if nowhere:
            return
        sure = [place for place in places if place is not None]
        for index, line in self._of_each(agreed, ground, sure):
            yield f"{name}: {held.strategies[index].agent}{line}"

    def _of_each(
        self, agreed: AgreedRound, ground: Ground, places: Sequence[int]
    ) -> Iterator[tuple[int, str]]:
        """Yield what is wrong with the strategies of each agent."""
        held = agreed.held
        opens_s, closes_s = self._window_s(held.round)
        openings = ground.openings.open_to(places)
        arrivals_s = [own.arrival_s for own in held.strategies]
        for index, (own, offer) in enumerate(zip(held.strategies, agreed.offers, strict=True)):
            is_open = next(openings)
            candidates = ground.candidates(offer, agreed.departure_s)
            if own.task_index not in candidates.steps:
                yield index, f" goes after step {own.task_index}, which it didn't offer"
                continue
            row = candidates.steps.index(own.task_index)
            yield from ((index, line) for line in _mistimed(own, candidates, row, places[index]))
            if self._keeps_places:
                is_open = np.arange(len(is_open)) == places[index]
            others_s = max([opens_s, *arrivals_s[:index], *arrivals_s[index + 1 :]])
            costs_s = _costs_s(candidates, len(places), others_s, opens_s)
            may = is_open & (candidates.arrival_s < closes_s - _SLACK_S)
            gain = _best(costs_s, may, costs_s[row, places[index]])
            if gain is not None:
                saved_s, step, place = gain
                x_m, y_m = ground.cells.centres_m[place].tolist()
                yield (
                    index,
                    (
                        f" alone could lower Φ by {saved_s:.6f} s: at ({x_m:.3f}, {y_m:.3f}) m "
                        f"after step {candidates.steps[step]}"
                    ),
                )

    def _window_s(self, number: int) -> tuple[float, float]:
        """Return from when on, and before when, a round's meeting may begin."""
        communication = self._scenario.communication
        period_s = communication.period_s
        return number * period_s, (number + 1) * period_s - communication.margin_s


def _flaw(scenario: Scenario, offer: MemberOffer) -> str:
    """Return why an offer can't be reckoned with, or ""."""
    if offer.agent not in scenario.agents:
        return "isn't one of the scenario's agents"
    drive = scenario.drive_of(offer.agent)
    for speed, true, unit in (
        (offer.linear_mps, drive.linear_mps, "m/s"),
        (offer.angular_radps, drive.angular_radps, "rad/s"),
    ):
        if abs(speed - true) > _SPEED_SLACK * true:
            return f"offers to go at {speed:g} {unit}, not at {true:g} {unit}"
    if not 1 < len(offer.stops) <= _MOST_STOPS:
        return f"offers {len(offer.stops)} steps, not 2 to {_MOST_STOPS}"
    unknown = set(offer.avoided) - scenario.workspace.regions.keys()
    return f"avoids {min(unknown)!r}, which is no region" if unknown else ""


def _is_middle(ground: Ground, own: Strategy, place: int | None) -> bool:
    if place is None:
        return False
    return math.dist(ground.cells.centres_m[place], (own.x_m, own.y_m)) <= _SAME_M


def _mistimed(own: Strategy, candidates: Candidates, row: int, place: int) -> Iterator[str]:
    """Say if t or δ of a strategy isn't what follows from the plan."""
    for name, said_s, true_s in (
        ("t", own.arrival_s, candidates.arrival_s[row, place]),
        ("δ", own.extra_travel_s, candidates.extra_s[row, place]),
    ):
        if not abs(said_s - true_s) <= _SLACK_S:
            yield f"'s {name} is {said_s:.6f} s, not {true_s:.6f} s as by its plan"


def _costs_s(
    candidates: Candidates, team: int, others_s: float, opens_s: float
) -> NDArray[np.float64]:
    """Return u_i of all candidates, counted from the window's opening; infinite where is none."""
    since_s = np.where(np.isfinite(candidates.arrival_s), candidates.arrival_s - opens_s, 0.0)
    latest_s = np.maximum(since_s, others_s - opens_s)
    costs_s: NDArray[np.float64] = candidates.extra_s + team * latest_s - since_s
    return costs_s


def _best(
    costs_s: NDArray[np.float64], may: NDArray[np.bool_], present_s: float
) -> tuple[float, int, int] | None:
    """Return by how much the best switch lowers the cost, its row and place, if it does."""
    open_s = np.where(may, costs_s, np.inf)
    best = int(np.argmin(open_s))
    saved_s = present_s - float(open_s.flat[best])
    row, place = divmod(best, costs_s.shape[1])
    return (saved_s, row, place) if _SLACK_S < saved_s < math.inf else None
