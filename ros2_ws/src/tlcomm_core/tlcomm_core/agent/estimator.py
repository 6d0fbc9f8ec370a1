"""What an agent takes the field to be: its own readings, and what neighbours say.

``Estimator``         one agent's, on integer nanoseconds
``create_estimator``  from a scenario
"""

from collections.abc import Iterable
from typing import Final

from tlcomm_core.agent.actions import (
    Action,
    CountIgnored,
    ReportEstimate,
    ReportTask,
    SayEstimate,
    TaskEventKind,
)
from tlcomm_core.agent.averaging import Averaging, Consensus, Exact
from tlcomm_core.protocol.messages import EstimateExchange
from tlcomm_core.protocol.reception import Reception
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.units import nanoseconds

__all__ = ["Estimator", "create_estimator"]


class Estimator:
    """Readings taken in, and exchanged with whoever is in range, for as long as that changes them.

    Exchanges are at the multiples of a period of simulated time, the same for all: at each, an
    agent steps by what was said before it, and says its estimate if that is new, or if a neighbour
    has come into range since it said it. So whatever the team is doing meanwhile, neighbours
    exchange; and once they agree, they are silent.

    Two agents reckon with each other once both have said something since they came into range:
    the same exchange at both ends, if nothing is lost. If something is, one of them waits in vain
    for the other to come nearer; then it asks, and the other repeats what it said last.
    """

    def __init__(
        self,
        own: str,
        members: Iterable[str],
        averaging: Averaging,
        period_ns: int,
        action: str,
    ) -> None:
        """Know nothing.

        Args:
            own: the agent's name.
            members: names of those whom it exchanges estimates with; its own may be among them.
            averaging: what to do with what is heard.
            period_ns: from one exchange to the next.
            action: that reads the field.
        """
        self._own: Final = own
        self._action: Final = action
        self._members: Final = frozenset(members)
        self._averaging: Final = averaging
        self._period_ns: Final = period_ns
        self._since_ns: dict[str, int] = {}
        self._heard: dict[str, tuple[EstimateExchange, ...]] = {}
        self._said: EstimateExchange | None = None
        self._measured: float | None = None
        self._reported: ReportEstimate | None = None
        self._step = -1
        self._due_ns: int | None = None
        self._has_news = False
        self._is_asked = False
        self._moved_by: dict[str, EstimateExchange] = {}

    @property
    def next_need_ns(self) -> int | None:
        """When ``proceed`` must be called again, whatever happens until then; or never."""
        return self._due_ns

    def measured_at(self, actions: Iterable[Action]) -> str:
        """Return the region in which the agent has just ended the action that reads the field."""
        for action in actions:
            if isinstance(action, ReportTask):
                event = action.event
                if event.kind is TaskEventKind.ACTION_FINISHED and event.action == self._action:
                    return event.region
        return ""

    def read(self, value: float, time_ns: int) -> None:
        """Take a reading: what the agent measured, and when; the estimate is reported anew."""
        self._measured = value
        self._reported = None
        self._averaging.measure(value, time_ns)
        self._has_news = True

    def see_neighbours(self, stamp_ns: int, neighbours: Iterable[str]) -> None:
        """Note who is in range from ``stamp_ns`` on."""
        before, now = self._since_ns, self._members.intersection(neighbours)
        if before.keys() == now:
            return
        self._since_ns = {name: before.get(name, stamp_ns) for name in sorted(now)}
        for name in before.keys() - now:
            self._heard.pop(name, None)
        self._has_news = True

    def hear(self, word: EstimateExchange, now_ns: int) -> tuple[Action, ...]:
        """Take in what a neighbour says; what follows from it is done by ``proceed``."""
        reception = self._receive(word, now_ns)
        return () if reception is Reception.ACCEPTED else (CountIgnored(reception.value),)

    def proceed(self, now_ns: int) -> tuple[Action, ...]:
        """Exchange, if it is time to and there is anything to; report a changed estimate."""
        if not self._has_news and (self._due_ns is None or now_ns < self._due_ns):
            return ()
        self._has_news = False
        said: tuple[Action, ...] = ()
        due_ns = self._next_exchange_ns(now_ns)
        if due_ns is not None and due_ns <= now_ns:
            said = self._exchange(now_ns // self._period_ns)
            self._due_ns = None
            due_ns = self._next_exchange_ns(now_ns)
        self._due_ns = due_ns
        return (*said, *self._report())

    def _receive(self, word: EstimateExchange, now_ns: int) -> Reception:
        if word.sender not in self._members or word.sender == self._own:
            return Reception.FOREIGN
        if any(each.agent not in self._members for each in word.known):
            return Reception.MALFORMED
        # A clock may be a little ahead of this agent's; what is far ahead is nobody's time.
        if word.step > now_ns // self._period_ns + 1:
            return Reception.EARLY
        before = self._heard.get(word.sender, ())
        if word.sender not in self._since_ns or (before and word.step <= before[-1].step):
            return Reception.LATE
        self._heard[word.sender] = (*before[-1:], word)
        self._has_news = True
        self._is_asked |= word.asks
        return Reception.ACCEPTED

    def _next_exchange_ns(self, now_ns: int) -> int | None:
        """Return when the next exchange is due; ``None`` if it would change nothing."""
        if not self._since_ns:
            return None
        if not (self._has_to_say() or self._averaging.moving(self._said, self._words())):
            return None
        if self._due_ns is not None:
            return self._due_ns
        return self._period_ns * max(-(-now_ns // self._period_ns), self._step + 1)

    def _exchange(self, step: int) -> tuple[Action, ...]:
        averaging, words = self._averaging, self._words(step)
        moving = averaging.moving(self._said, words)
        averaging.exchange(self._said, words)
        # Whom a word moves also moves its sender, who says so: unless something was lost.
        asks = any(self._moved_by.get(word.sender) == word for word in moving)
        self._moved_by.update((word.sender, word) for word in moving)
        self._step = step
        if averaging.estimate is None or not (moving or self._has_to_say()):
            return ()
        self._said = EstimateExchange(
            self._own, step, len(self._since_ns), asks, averaging.estimate, averaging.known
        )
        self._is_asked = False
        return (SayEstimate(self._said),)

    def _has_to_say(self) -> bool:
        """Tell whether some neighbour hasn't been told, or has missed, what this agent knows."""
        said, averaging = self._said, self._averaging
        if averaging.estimate is None:
            return False
        if said is None or said.value != averaging.estimate or said.known != averaging.known:
            return True
        return self._is_asked or max(self._since_ns.values()) > said.step * self._period_ns

    def _words(self, before: int | None = None) -> list[EstimateExchange]:
        """Return what each neighbour said last, if they have been told something as well.

        Args:
            before: the number of an exchange, before which it was said.
        """
        words = []
        for name, heard in self._heard.items():
            since_ns = self._since_ns[name]
            if self._said is not None and self._said.step * self._period_ns < since_ns:
                continue
            told = [word for word in heard if before is None or word.step < before]
            if told and told[-1].step * self._period_ns >= since_ns:
                words.append(told[-1])
        return words

    def _report(self) -> tuple[Action, ...]:
        estimate = self._averaging.estimate
        if estimate is None:
            return ()
        report = ReportEstimate(estimate, self._measured)
        if report == self._reported:
            return ()
        self._reported = report
        return (report,)


def create_estimator(name: str, scenario: Scenario, members: Iterable[str]) -> Estimator | None:
    """Return the estimator of a member of the scenario's team; ``None`` if there is no field.

    Args:
        name: the agent's name.
        scenario: with the field.
        members: names of those whom it exchanges estimates with.
    """
    if scenario.field is None:
        return None
    exchange = scenario.field.exchange
    averaging: Averaging = Exact(name)
    if exchange.mode == "consensus":
        averaging = Consensus(name, exchange.step, exchange.tolerance)
    period_ns = nanoseconds(exchange.period_s)
    return Estimator(name, members, averaging, period_ns, scenario.field.action)
