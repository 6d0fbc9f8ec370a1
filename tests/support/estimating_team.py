"""Estimators on a graph, beside each other: what is said at one instant is heard a hop later."""

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence

from tlcomm_core.agent.actions import ReportEstimate, SayEstimate
from tlcomm_core.agent.averaging import Averaging, Consensus
from tlcomm_core.agent.estimator import Estimator

__all__ = ["ACTION", "LATENCY_NS", "PERIOD_NS", "EstimatingTeam"]

PERIOD_NS = 100_000_000
LATENCY_NS = 5_000_000
ACTION = "measure"

Heard = Callable[[int, str, str], bool]


def _always(step: int, sender: str, receiver: str) -> bool:
    del step, sender, receiver
    return True


class EstimatingTeam:
    """Estimators whose links are edges of a graph that may change.

    Attributes:
        said: how many messages so far.
        asked: how many of them asked for what was lost.
        now_ns: the time.
        history: each member's estimates, as reported.
    """

    def __init__(
        self,
        names: Sequence[str],
        averaging: Callable[[str], Averaging] = lambda own: Consensus(own, None, 0.01),
        is_heard: Heard = _always,
    ) -> None:
        """Begin without links, a hop after t = 0, at which nobody had anything to say.

        Args:
            names: of the members.
            averaging: makes each one's.
            is_heard: tells of the number of an exchange, sender and receiver whether what is said
                is heard.
        """
        self.members = {
            name: Estimator(name, names, averaging(name), PERIOD_NS, ACTION) for name in names
        }
        self.said = 0
        self.asked = 0
        self.now_ns = LATENCY_NS
        self.history: dict[str, list[float]] = {name: [] for name in names}
        self._is_heard = is_heard
        self._edges: set[frozenset[str]] = set()

    @property
    def values(self) -> dict[str, float]:
        """Each member's estimate, of those that have one."""
        return {name: values[-1] for name, values in self.history.items() if values}

    @property
    def is_silent(self) -> bool:
        """Whether nobody has anything to do any more."""
        return all(member.next_need_ns is None for member in self.members.values())

    def link(self, edges: Iterable[Collection[str]]) -> None:
        """Let these be the links from now on."""
        self._edges = {frozenset(edge) for edge in edges}
        for name, member in self.members.items():
            near = {other for edge in self._edges if name in edge for other in edge - {name}}
            member.see_neighbours(self.now_ns, near)
        self._step(self.members)

    def read(self, readings: Mapping[str, float]) -> None:
        """Let members measure."""
        for name, value in readings.items():
            self.members[name].read(value, self.now_ns)
        self._step(readings)

    def run(self, most: int = 5000) -> int:
        """Let them exchange until they are silent; return how many exchanges that took."""
        for count in range(most):
            if self.is_silent:
                return count
            self.exchange()
        raise AssertionError(f"not silent after {most} exchanges")

    def exchange(self) -> None:
        """Go to the next exchange, and to when what was said is heard."""
        self.now_ns = (self.now_ns // PERIOD_NS + 1) * PERIOD_NS
        words = self._step(self.members)
        self.now_ns += LATENCY_NS
        for word in words:
            for name, member in self.members.items():
                is_linked = frozenset({name, word.message.sender}) in self._edges
                if is_linked and self._is_heard(word.message.step, word.message.sender, name):
                    member.hear(word.message, self.now_ns)
        self._step(self.members)

    def _step(self, names: Iterable[str]) -> list[SayEstimate]:
        said: list[SayEstimate] = []
        for name in names:
            for action in self.members[name].proceed(self.now_ns):
                match action:
                    case SayEstimate():
                        said.append(action)
                    case ReportEstimate(value=value):
                        self.history[name].append(value)
        self.said += len(said)
        self.asked += sum(action.message.asks for action in said)
        return said
