"""The neighbour-min consensus that picks i*, exchange by exchange.

``MinimumConsensus``  one agent's part, over all iterations of a round

Each iteration ends with everyone knowing the least word of all: the best team strategy proposed,
or the smallest change in an iteration of Algorithm 1. With D the diameter of the meeting graph, D
synchronous exchanges do it: in exchange h everyone tells its neighbours the least word that it has
seen, and goes on when it has heard the same from all of them. By induction, after exchange h an
agent knows the minimum over everyone within h + 1 hops at least; after D exchanges that is the
whole team.

Exchanges are numbered through all iterations: step = iteration·D + hop. An agent enters step s + 1
only after hearing step s (or s + 1) from *every* neighbour. Hence

* a neighbour is at most one step ahead: a message of step s or s + 1 can be needed, and is kept
  until it is; anything later is no honest neighbour's;
* a neighbour is at most one step behind: re-sending one's last two messages serves it, whatever
  was lost; anything earlier is late or a duplicate.

Within an iteration, a neighbour's word of the next step stands for its word of this one, if that is
lost: it is the least of more agents' words, all of the same iteration, and minima don't mind whom
they have counted before. An iteration's last step has no such substitute.

The first message of a neighbour for a step stays; a second, different one is a contradiction and
ignored, so that repeating or reordering messages never changes what is concluded.
"""

from collections.abc import Iterable
from dataclasses import replace

from tlcomm_core.errors import LocalMisuseError
from tlcomm_core.protocol.messages import Word
from tlcomm_core.protocol.reception import Reception

__all__ = ["MinimumConsensus"]


class MinimumConsensus:
    """One agent's part in agreeing on the least word, iteration by iteration."""

    def __init__(self, own: str, neighbours: Iterable[str], exchanges: int) -> None:
        """Begin before the first iteration.

        Args:
            own: this agent's name.
            neighbours: its neighbours in the meeting graph.
            exchanges: D ≥ 1, the meeting graph's diameter (1 also for a team of one).
        """
        self._own = own
        self._neighbours = frozenset(neighbours)
        self._exchanges = exchanges
        self._step = -1
        self._heard: dict[int, dict[str, Word]] = {}
        self._sent: list[Word] = []
        self._said: Word | None = None

    @property
    def iteration(self) -> int:
        """The iteration under way; −1 before the first."""
        return self._step // self._exchanges

    @property
    def unsuperseded(self) -> tuple[Word, ...]:
        """The messages that some neighbour may still need: the last two."""
        return tuple(self._sent)

    def begin(self, word: Word) -> Word:
        """Begin the next iteration with one's own word; return what to say."""
        if (self._step + 1) % self._exchanges != 0:
            raise LocalMisuseError(f"an iteration was begun in the middle of step {self._step!r}")
        self._said = self._say(word)
        return self._said

    def hear(self, message: Word) -> Reception:
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

    def advance(self) -> Word | None:
        """Go one exchange on, if all neighbours have been heard.

        Returns:
            What to say next, or ``None`` if a neighbour is still missing or the iteration's
            exchanges are done (see ``conclusion``).
        """
        if not self._is_step_complete() or self._is_last_exchange():
            return None
        return self._say(self._minimum())

    @property
    def conclusion(self) -> Word | None:
        """The iteration's least word, once all of its exchanges are done."""
        if self._is_last_exchange() and self._is_step_complete():
            return self._minimum()
        return None

    @property
    def awaited(self) -> str | None:
        """A neighbour without whose word the exchange under way can't end, if there is one."""
        return min(self._neighbours.difference(self._words), default=None)

    @property
    def has_heard_all(self) -> bool:
        """Whether each neighbour has been heard at least once."""
        return self._step > 0 or self._is_step_complete()

    def _is_possible(self, message: Word) -> bool:
        """Return whether the ticket exists; before the first exchange all speak for themselves."""
        return (
            message.iteration >= 0
            and 0 <= message.hop < self._exchanges
            and (message.hop > 0 or message.candidate == message.sender)
        )

    def _is_own(self, message: Word) -> bool:
        """Return whether a peer repeats what was said here at the beginning of the iteration."""
        return self._said is not None and message.claim == self._said.claim

    def _is_last_exchange(self) -> bool:
        return self._step >= 0 and (self._step + 1) % self._exchanges == 0

    def _is_step_complete(self) -> bool:
        return self._words.keys() >= self._neighbours

    @property
    def _words(self) -> dict[str, Word]:
        """What neighbours have said for the step under way, or in this iteration after it."""
        later = {} if self._is_last_exchange() else self._heard.get(self._step + 1, {})
        return {**later, **self._heard.get(self._step, {})}

    def _minimum(self) -> Word:
        heard = [self._sent[-1], *self._words.values()]
        return min(heard, key=lambda word: word.priority).joined(heard)

    def _say(self, word: Word) -> Word:
        """Enter the next step with the least word seen so far."""
        self._heard.pop(self._step, None)
        self._step += 1
        iteration, hop = divmod(self._step, self._exchanges)
        message = replace(word, sender=self._own, iteration=iteration, hop=hop)
        self._sent = [*self._sent[-1:], message]
        return message
