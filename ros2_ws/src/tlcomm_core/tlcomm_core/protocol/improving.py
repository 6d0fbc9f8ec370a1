"""The second phase: Algorithm 1, each agent with its own candidates and the others' words.

``Improving``  one agent's part in it
"""

import math
from collections.abc import Iterable

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.game.best_response import Search, best_response
from tlcomm_core.game.initial import initial_profile
from tlcomm_core.game.potential import evaluate, potential
from tlcomm_core.game.problem import Choice, RoundProblem
from tlcomm_core.game.strategy import Strategy, TeamStrategy
from tlcomm_core.protocol.consensus import MinimumConsensus
from tlcomm_core.protocol.messages import BestResponse
from tlcomm_core.protocol.reception import Reception

__all__ = ["Improving"]


class Improving:
    """One agent's part in improving S⁰ to a Nash equilibrium.

    All members hold the same S⁰ since they hold the same offers. In each iteration each finds the
    best response to the strategies it holds, the consensus picks i*, and all replace the same
    entry by the values that came with the minimum. So by induction all hold the same strategies
    at each iteration, and end at the same one.

    Source: Algorithm 1 of the paper.
    """

    def __init__(
        self,
        own: str,
        problem: RoundProblem,
        neighbours: Iterable[str],
        exchanges: int,
        max_iterations: int,
    ) -> None:
        """Compute S⁰ and one's own best response to it.

        Args:
            own: this agent's name.
            problem: the round; of the others' candidates only S⁰ makes use.
            neighbours: the agent's neighbours in the meeting graph.
            exchanges: the meeting graph's diameter, at least 1.
            max_iterations: K.

        Raises:
            InfeasibleRoundError: no admissible meeting exists.
        """
        initial = initial_profile(problem)
        strategies = problem.strategies(initial)
        self._own = own
        self._problem = problem
        self._index = problem.agents.index(own)
        self._choice = initial.choice(self._index)
        self._strategies = {strategy.agent: strategy for strategy in strategies}
        self._initial_potential_s = potential(strategies, problem.window_s[0])
        self._search = Search(max_iterations=max_iterations)
        self._consensus = MinimumConsensus(own, problem.round, neighbours, exchanges)
        self._owed = [self._respond()]

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
        )

    @property
    def unsuperseded(self) -> tuple[BestResponse, ...]:
        """The messages that some neighbour may still need."""
        return self._consensus.unsuperseded

    def hear(self, message: BestResponse) -> Reception:
        """Take in a neighbour's minimum."""
        strategy = message.strategy
        if not self._strategies.keys() >= {message.candidate, strategy.agent}:
            return Reception.FOREIGN
        if strategy.agent != message.candidate or not self._is_sound(message.change_s, strategy):
            return Reception.MALFORMED
        return self._consensus.hear(message)

    @property
    def awaited(self) -> str | None:
        """A neighbour without whose word this phase can't go on, if there is one."""
        return self._consensus.awaited

    @property
    def is_begun_by_all(self) -> bool:
        """Whether all neighbours are known to be in this phase too, or past it."""
        return self._consensus.has_heard_all

    def _is_sound(self, change_s: float, strategy: Strategy) -> bool:
        """Return whether the values can be those of an agent's best response."""
        return (
            -math.inf < change_s <= 0.0
            and self._problem.links.place_at(strategy.x_m, strategy.y_m) is not None
            and -math.inf < strategy.extra_travel_s < math.inf
            and -math.inf < strategy.arrival_s < self._problem.window_s[1]
        )

    def owed(self) -> list[BestResponse]:
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

    def _conclude(self, least: BestResponse) -> BestResponse | None:
        """Make i*'s move, if it gains by one; begin the next iteration, if there is one."""
        if least.change_s < 0.0:
            self._strategies[least.candidate] = least.strategy
            if least.candidate == self._own:
                self._choice = self._response
        self._search = self._search.after(least.change_s)
        return None if self._search.scope is None else self._respond()

    def _respond(self) -> BestResponse:
        """Begin an iteration with the own best response."""
        if self._search.scope is None:
            raise LocalMisuseError("a best response was asked for after the search")
        others = [s for name, s in self._strategies.items() if name != self._own]
        response = best_response(
            self._problem, self._index, self._choice, others, self._search.scope
        )
        self._response: Choice = response.choice
        strategy: Strategy = self._problem.strategy(
            self._index, response.location, response.candidate
        )
        return self._consensus.begin(response.change_s, strategy)
