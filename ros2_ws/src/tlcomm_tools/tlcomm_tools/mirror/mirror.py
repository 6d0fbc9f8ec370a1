"""Recorded messages in, mirrored messages out: without ROS, without a clock.

``Recorded``  a message as it was recorded
``Mirrored``  a message for viewers
``Mirror``    makes the ones of the others
"""

from collections.abc import Iterator, Sequence
from operator import itemgetter
from typing import Final

from rosbags.typesys.store import Typestore

from tlcomm_core.method import Method
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.units import nanoseconds
from tlcomm_tools.bag.topics import Topic, mirror_topics
from tlcomm_tools.mirror.diagnostics import make_diagnostics
from tlcomm_tools.mirror.intake import Intake
from tlcomm_tools.mirror.markers import make_region_markers, make_team_markers
from tlcomm_tools.mirror.paths import encode_plan, encode_trail
from tlcomm_tools.mirror.picture import Picture
from tlcomm_tools.mirror.way import Way

__all__ = ["Mirror", "Mirrored", "Recorded"]

_PERIOD_NS: Final = nanoseconds(1.0)
# Paths are most of the work and of the bytes.
_PATH_PERIOD_NS: Final = nanoseconds(2.0)

# stamp (ns), topic's number among the recorded ones, data
Recorded = tuple[int, int, bytes]
# topic's number among the mirrors, stamp (ns), data
Mirrored = tuple[int, int, bytes]


class Mirror:
    """Makes mirrors once a simulated second, paths every two, at each as of then.

    What it makes is a function of what it takes: where messages are taken in order of time, as in
    lock step and from a bag, the mirrors of equal runs are equal.

    Attributes:
        topics: of the mirrors.
        store: the types of recorded and mirrored topics.
    """

    def __init__(
        self, scenario: Scenario, method: Method, recorded: Sequence[Topic], store: Typestore
    ) -> None:
        """Begin before time 0.

        Args:
            scenario: what is run.
            method: how.
            recorded: what is taken; a topic's place in this sequence is its number.
            store: the types of recorded and mirrored topics.
        """
        self.topics: Final = mirror_topics(scenario.agents)
        self._numbers: Final = {topic.name: own for own, topic in enumerate(self.topics)}
        self._picture: Final = Picture(scenario, method)
        self._intake: Final = Intake(self._picture, store)
        self._recorded: Final = tuple(recorded)
        self._wanted: Final = frozenset(
            number for number, topic in enumerate(recorded) if self._intake.wants(topic)
        )
        self._ways: Final = {name: Way(name) for name in scenario.agents}
        self.store: Final = store
        self._pending: list[Recorded] = []
        self._due_ns = 0

    def take(self, number: int, stamp_ns: int, data: bytes) -> None:
        """Take a message, to be looked at when time goes on."""
        if number in self._wanted:
            self._pending.append((stamp_ns, number, data))

    def advance(self, until_ns: int) -> Iterator[Mirrored]:
        """Look at all that was taken, in order of time; yield the mirrors that are due.

        Args:
            until_ns: everything up to then has been taken.
        """
        if until_ns < self._due_ns:
            return
        pending, self._pending = self._pending, []
        for stamp_ns, number, data in sorted(pending, key=itemgetter(0, 1)):
            if stamp_ns > until_ns:
                self._pending.append((stamp_ns, number, data))
                continue
            while self._due_ns < stamp_ns:
                yield from self._mirrors()
            self._intake.take(self._recorded[number], data)
        while self._due_ns <= until_ns:
            yield from self._mirrors()

    def _mirrors(self) -> Iterator[Mirrored]:
        now_ns = self._due_ns
        self._due_ns += _PERIOD_NS
        for name, data in self._made(now_ns):
            yield self._numbers[name], now_ns, data

    def _made(self, now_ns: int) -> Iterator[tuple[str, bytes]]:
        picture = self._picture
        if now_ns == 0:
            yield self._encoded("/region_markers", make_region_markers(picture, now_ns))
        yield self._encoded("/team_markers", make_team_markers(picture, now_ns))
        yield self._encoded("/diagnostics", make_diagnostics(picture, now_ns))
        if now_ns % _PATH_PERIOD_NS:
            return
        for name, agent in picture.agents.items():
            ahead = self._ways[name].ahead(picture)
            yield f"/{name}/plan", encode_plan(agent.odometry, ahead, now_ns)
            yield f"/{name}/trail", encode_trail(agent.trail, now_ns)

    def _encoded(self, name: str, message: object) -> tuple[str, bytes]:
        kind = self.topics[self._numbers[name]].type
        return name, bytes(self.store.serialize_cdr(message, kind))
