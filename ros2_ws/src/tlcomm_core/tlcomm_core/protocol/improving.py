"""The second phase: proposals and Algorithm 1, each agent with what the others say.

``Improving``  one agent's part in it
"""

import math
from collections.abc import Iterable

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.game.best_response import Scope, Search, best_response
from tlcomm_core.game.initial import initial_profile
from tlcomm_core.game.potential import evaluate, potential
from tlcomm_core.game.problem import Choice, Profile, RoundProblem
from tlcomm_core.game.recognition import POTENTIAL_TOLERANCE_S, recognise
from tlcomm_core.game.solver import Propose, Solver
from tlcomm_core.game.strategy import TeamStrategy
from tlcomm_core.protocol.consensus import MinimumConsensus
from tlcomm_core.protocol.messages import BestResponse, Proposal, Word
from tlcomm_core.protocol.reception import Reception

__all__ = ["Improving"]


class Improving:
    """One agent's part in improving S⁰ to a Nash equilibrium.

    All members hold the same S⁰ since they hold the same offers. With a solver that proposes, the
    first iteration compares everybody's proposal, and all replace S⁰ by the best. In each further
    iteration each finds the best response to the strategies it holds, the consensus picks i*, and
    all replace the same entry by the values that came with the minimum. So by induction all hold
    the same strategies at each iteration, and end at the same one.

    A proposal is taken only if it is what this agent could have found itself: candidates of the
    round, connected, with the potential that it claims.

    Source: Algorithm 1 of the paper.
    """

    def __init__(
        self,
        own: str,
        round_: int,
        problem: RoundProblem,
        neighbours: Iterable[str],
        exchanges: int,
        solver: Solver,
        max_iterations: int,
    ) -> None:
        """Compute S⁰ and one's own first word: a proposal, or the best response to S⁰.

        Args:
            own: this agent's name.
            round_: the round under negotiation.
            problem: that round, or the one after it if it is skipped; of the others' candidates
                only S⁰ and proposals make use.
            neighbours: the agent's neighbours in the meeting graph.
            exchanges: the meeting graph's diameter, at least 1.
            solver: what to propose.
            max_iterations: K.

        Raises:
            InfeasibleRoundError: no admissible meeting exists.
        """
        initial = initial_profile(problem)
        strategies = problem.strategies(initial)
        self._own = own
        self._round = round_
        self._problem = problem
        self._index = problem.agents.index(own)
        self._choice = initial.choice(self._index)
        self._strategies = {strategy.agent: strategy for strategy in strategies}
        self._initial_potential_s = potential(strategies, problem.window_s[0])
        self._bound_s: float | None = None
        # Proposals end where single moves have nothing left in the balls; all places decide.
        scope = Scope.BALL if solver.propose is None else Scope.EVERYWHERE
        self._first_response = 0 if solver.propose is None else 1
        self._search = Search(scope=scope, max_iterations=max_iterations)
        self._consensus = MinimumConsensus(own, neighbours, exchanges)
        self._owed: list[Word] = [
            self._respond() if solver.propose is None else self._propose(solver.propose, initial)
        ]

    @property
    def iteration(self) -> int:
        """The iteration under way or, at the end, the last."""
        return self._consensus.iteration

    @property
    def result(self) -> TeamStrategy | None:
        """The team strategy, once the search is over."""
        if self._search.scope is not None:
            return None
        return evaluate(
            self._problem.round,
            tuple(self._strategies.values()),
            self._problem.window_s[0],
            self._search.moves,
            self._initial_potential_s,
            self._bound_s,
        )

    @property
    def unsuperseded(self) -> tuple[Word, ...]:
        """The messages that some neighbour may still need."""
        return self._consensus.unsuperseded

    def hear(self, message: Word) -> Reception:
        """Take in a neighbour's minimum."""
        match message:
            case Proposal():
                named = {message.candidate, *(own.agent for own in message.strategies)}
                is_sound = self._is_sound_proposal(message)
            case BestResponse():
                named = {message.candidate, message.strategy.agent}
                is_sound = self._is_sound_response(message)
        if not self._strategies.keys() >= named:
            return Reception.FOREIGN
        return self._consensus.hear(message) if is_sound else Reception.MALFORMED

    @property
    def awaited(self) -> str | None:
        """A neighbour without whose word this phase can't go on, if there is one."""
        return self._consensus.awaited

    @property
    def is_begun_by_all(self) -> bool:
        """Whether all neighbours are known to be in this phase too, or past it."""
        return self._consensus.has_heard_all

    def _is_sound_response(self, message: BestResponse) -> bool:
        """Return whether the values can be those of an agent's best response."""
        strategy = message.strategy
        return (
            message.iteration >= self._first_response
            and strategy.agent == message.candidate
            and -math.inf < message.change_s <= 0.0
            and self._problem.links.place_at(strategy.x_m, strategy.y_m) is not None
            and -math.inf < strategy.extra_travel_s < math.inf
            and -math.inf < strategy.arrival_s < self._problem.window_s[1]
        )

    def _is_sound_proposal(self, message: Proposal) -> bool:
        """Return whether the strategies are the round's, with the potential claimed."""
        return (
            message.iteration < self._first_response
            and message.bound_s <= message.potential_s + POTENTIAL_TOLERANCE_S
            and recognise(self._problem, message.strategies, message.potential_s) is not None
        )

    def owed(self) -> list[Word]:
        """Go as far as what was heard allows; return what is to be said on the way."""
        while self._search.scope is not None:
            message = self._consensus.advance()
            if message is None:
                least = self._consensus.conclusion
                if least is None:
                    break
                message = self._conclude(least)
            if message is not None:
                self._owed.append(message)
        said, self._owed = self._owed, []
        return said

    def _conclude(self, least: Word) -> Word | None:
        """Take the best proposal, or make i*'s move if it gains by one; go on, if need be."""
        match least:
            case Proposal():
                self._adopt(least)
                return self._respond()
            case BestResponse():
                self._move(least)
                return None if self._search.scope is None else self._respond()

    def _adopt(self, proposal: Proposal) -> None:
        profile = recognise(self._problem, proposal.strategies, proposal.potential_s)
        if profile is None:
            raise LocalMisuseError(f"a proposal of {proposal.candidate!r} was compared unseen")
        self._choice = profile.choice(self._index)
        self._strategies = {strategy.agent: strategy for strategy in proposal.strategies}
        self._bound_s = proposal.bound_s if proposal.bound_s > -math.inf else None

    def _move(self, least: BestResponse) -> None:
        if least.change_s < 0.0:
            self._strategies[least.candidate] = least.strategy
            if least.candidate == self._own:
                self._choice = self._response
        self._search = self._search.after(least.change_s)

    def _propose(self, propose: Propose, initial: Profile) -> Word:
        """Begin with the own proposal."""
        proposed = propose(self._problem, initial, self._index)
        strategies = self._problem.strategies(proposed.profile)
        return self._consensus.begin(
            Proposal(
                sender=self._own,
                round=self._round,
                iteration=0,
                hop=0,
                candidate=self._own,
                potential_s=potential(strategies, self._problem.window_s[0]),
                bound_s=proposed.bound_s,
                strategies=strategies,
            )
        )

    def _respond(self) -> Word:
        """Begin an iteration with the own best response."""
        if self._search.scope is None:
            raise LocalMisuseError("a best response was asked for after the search")
        others = [s for name, s in self._strategies.items() if name != self._own]
        response = best_response(
            self._problem, self._index, self._choice, others, self._search.scope
        )
        self._response: Choice = response.choice
        return self._consensus.begin(
            BestResponse(
                sender=self._own,
                round=self._round,
                iteration=self._consensus.iteration + 1,
                hop=0,
                candidate=self._own,
                change_s=response.change_s,
                strategy=self._problem.strategy(self._index, response.location, response.candidate),
            )
        )
