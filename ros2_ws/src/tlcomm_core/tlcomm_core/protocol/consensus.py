"""The neighbour-min consensus that picks i*, exchange by exchange.

``MinimumConsensus``  one agent's part, over all iterations of a round

Each iteration of Algorithm 1 ends with everyone knowing the smallest change of all. With D the
diameter of the meeting graph, D synchronous exchanges do it: in exchange h everyone tells its
neighbours the smallest change that it has seen, and goes on when it has heard the same from all of
them. By induction, after exchange h an agent knows the minimum over everyone within h + 1 hops;
after D exchanges that is the whole team.

Exchanges are numbered through all iterations: step = iteration·D + hop. An agent enters step s + 1
only after hearing step s from *every* neighbour. Hence

* a neighbour is at most one step ahead: a message of step s or s + 1 can be needed, and is kept
  until it is; anything later is no honest neighbour's;
* a neighbour is at most one step behind: re-sending one's last two messages serves it, whatever
  was lost; anything earlier is late or a duplicate.

The first message of a neighbour for a step stays; a second, different one is a contradiction and
ignored, so that repeating or reordering messages never changes what is concluded.
"""

from collections.abc import Iterable

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.game.best_response import priority
from tlcomm_core.game.strategy import Strategy
from tlcomm_core.protocol.messages import BestResponse
from tlcomm_core.protocol.reception import Reception

__all__ = ["MinimumConsensus"]


class MinimumConsensus:
    """One agent's part in agreeing on the smallest change, iteration by iteration."""

    def __init__(self, own: str, round_: int, neighbours: Iterable[str], exchanges: int) -> None:
        """Begin before the first iteration.

        Args:
            own: this agent's name.
            round_: the round that is being planned.
            neighbours: its neighbours in the meeting graph.
            exchanges: D ≥ 1, the meeting graph's diameter (1 also for a team of one).
        """
        self._own = own
        self._round = round_
        self._neighbours = frozenset(neighbours)
        self._exchanges = exchanges
        self._step = -1
        self._heard: dict[int, dict[str, BestResponse]] = {}
        self._sent: list[BestResponse] = []
        self._response: tuple[int, float, Strategy] | None = None

    @property
    def iteration(self) -> int:
        """The iteration under way; −1 before the first."""
        return self._step // self._exchanges

    @property
    def unsuperseded(self) -> tuple[BestResponse, ...]:
        """The messages that some neighbour may still need: the last two."""
        return tuple(self._sent)

    def begin(self, change_s: float, strategy: Strategy) -> BestResponse:
        """Begin the next iteration with one's own best response; return what to say."""
        if (self._step + 1) % self._exchanges != 0:
            raise LocalMisuseError(f"an iteration was begun in the middle of step {self._step!r}")
        self._response = (self.iteration + 1, change_s, strategy)
        return self._say(self._own, change_s, strategy)

    def hear(self, message: BestResponse) -> Reception:
        """Take a message of this round; nothing else changes until ``advance``."""
        if message.sender not in self._neighbours:
            return Reception.UNNEEDED
        if not self._is_possible(message):
            return Reception.MALFORMED
        step = message.iteration * self._exchanges + message.hop
        if not self._step <= step <= self._step + 1:
            return Reception.LATE if step < self._step else Reception.EARLY
        if message.candidate == self._own and not self._is_own(message):
            return Reception.CONFLICTING
        earlier = self._heard.get(step, {}).get(message.sender)
        if earlier is None:
            self._heard.setdefault(step, {})[message.sender] = message
            return Reception.ACCEPTED
        return Reception.DUPLICATE if earlier == message else Reception.CONFLICTING

    def advance(self) -> BestResponse | None:
        """Go one exchange on, if all neighbours have been heard.

        Returns:
            What to say next, or ``None`` if a neighbour is still missing or the iteration's
            exchanges are done (see ``conclusion``).
        """
        if not self._is_step_complete() or self._is_last_exchange():
            return None
        least = self._minimum()
        return self._say(least.candidate, least.change_s, least.strategy)

    @property
    def conclusion(self) -> BestResponse | None:
        """The iteration's smallest change, once all of its exchanges are done."""
        if self._is_last_exchange() and self._is_step_complete():
            return self._minimum()
        return None

    @property
    def awaited(self) -> str | None:
        """A neighbour without whose word the exchange under way can't end, if there is one."""
        return min(self._neighbours.difference(self._heard.get(self._step, ())), default=None)

    @property
    def has_heard_all(self) -> bool:
        """Whether each neighbour has been heard at least once."""
        return self._step > 0 or self._is_step_complete()

    def _is_possible(self, message: BestResponse) -> bool:
        """Return whether the ticket exists; before the first exchange all speak for themselves."""
        return (
            message.iteration >= 0
            and 0 <= message.hop < self._exchanges
            and (message.hop > 0 or message.candidate == message.sender)
        )

    def _is_own(self, message: BestResponse) -> bool:
        """Return whether a peer repeats what was said here at the beginning of the iteration."""
        return (message.iteration, message.change_s, message.strategy) == self._response

    def _is_last_exchange(self) -> bool:
        return self._step >= 0 and (self._step + 1) % self._exchanges == 0

    def _is_step_complete(self) -> bool:
        return self._heard.get(self._step, {}).keys() >= self._neighbours

    def _minimum(self) -> BestResponse:
        return min(
            [self._sent[-1], *self._heard.get(self._step, {}).values()],
            key=lambda response: priority(response.change_s, response.candidate),
        )

    def _say(self, candidate: str, change_s: float, strategy: Strategy) -> BestResponse:
        """Enter the next step with the smallest change seen so far."""
        self._heard.pop(self._step, None)
        self._step += 1
        iteration, hop = divmod(self._step, self._exchanges)
        message = BestResponse(
            sender=self._own,
            round=self._round,
            iteration=iteration,
            hop=hop,
            candidate=candidate,
            change_s=change_s,
            strategy=strategy,
        )
        self._sent = [*self._sent[-1:], message]
        return message
