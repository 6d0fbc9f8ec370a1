"""One agent's record beside what comes out of a fresh brain.

``Comparison``  instant by instant, up to the first difference
``Difference``  where a brain does something else than was recorded
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import zip_longest
from typing import Any, Final

from tlcomm_core.units import seconds
from tlcomm_tools.verification.mismatch import first_mismatch
from tlcomm_tools.verification.outputs import HEARING, Failure, Output

__all__ = ["Comparison", "Difference"]

_NOTHING: Final = "nothing"


@dataclass(frozen=True, slots=True)
class Difference:
    """Where a brain does something else than was recorded.

    Attributes:
        agent: whose.
        time_ns: when.
        topic: of what.
        where: the part of the message that differs; "" for the whole.
        recorded: what was recorded.
        came_out: what came out.
    """

    agent: str
    time_ns: int
    topic: str
    where: str
    recorded: str
    came_out: str

    def __str__(self) -> str:
        """Return a line that says it all."""
        part = f" {self.where}" if self.where else ""
        return (
            f"{self.agent} at {seconds(self.time_ns):.9f} s, {self.topic}{part}: "
            f"recorded {self.recorded}, came out {self.came_out}"
        )

    def document(self) -> dict[str, Any]:
        """Return it as a JSON document."""
        return {
            "agent": self.agent,
            "time_s": seconds(self.time_ns),
            "topic": self.topic,
            "where": self.where or None,
            "recorded": self.recorded,
            "came_out": self.came_out,
        }


class Comparison:
    """One agent's record beside what comes out.

    What comes out at the very last instant needn't be recorded any more: a record may end in the
    middle of it.

    Attributes:
        instants: at how many the agent has acted.
        outputs: how many recorded messages have come out again.
    """

    def __init__(
        self,
        agent: str,
        recorded: dict[int, list[Output]],
        end_ns: int,
        heard_until_ns: int | None = None,
    ) -> None:
        """Begin with nothing compared.

        Args:
            agent: whose record it is.
            recorded: what the agent did at which instants, in order of time.
            end_ns: the last instant of the record.
            heard_until_ns: up to when it has what the agent heard; ``None``: not at all.
        """
        self.instants = 0
        self.outputs = 0
        self._agent: Final = agent
        self._recorded: Final = dict(recorded)
        self._end_ns: Final = end_ns
        self._heard_until_ns: Final = -1 if heard_until_ns is None else heard_until_ns

    def compare(
        self, instants: Iterable[tuple[int, Sequence[Output]]], until_ns: int
    ) -> Difference | None:
        """Return the first difference up to a time; ``None`` if there is none."""
        for now_ns, came_out in instants:
            found = self._missed_before(now_ns) or self._compare_instant(now_ns, came_out)
            if found is not None:
                return found
            self.instants += 1
        return self._missed_before(until_ns + 1)

    def _missed_before(self, time_ns: int) -> Difference | None:
        """Return what was recorded earlier than that, and hasn't come out."""
        earliest_ns = next(iter(self._recorded), time_ns)
        if earliest_ns >= time_ns:
            return None
        return self._difference(earliest_ns, self._recorded[earliest_ns][0], None)

    def _compare_instant(self, now_ns: int, came_out: Sequence[Output]) -> Difference | None:
        recorded = self._recorded.pop(now_ns, [])
        if now_ns > self._heard_until_ns:
            came_out = [own for own in came_out if own.topic != HEARING]
        for topic in dict.fromkeys(own.topic for own in (*came_out, *recorded)):
            pairs = zip_longest(
                [own for own in recorded if own.topic == topic],
                [own for own in came_out if own.topic == topic],
            )
            for one, other in pairs:
                if one != other and not self._is_unrecorded(now_ns, one, other):
                    return self._difference(now_ns, one, other)
                self.outputs += one is not None
        return None

    def _is_unrecorded(self, now_ns: int, recorded: Output | None, came_out: Output | None) -> bool:
        """Tell whether something may have come out too late to be recorded."""
        is_failure = came_out is not None and isinstance(came_out.value, Failure)
        return recorded is None and now_ns == self._end_ns and not is_failure

    def _difference(
        self, time_ns: int, recorded: Output | None, came_out: Output | None
    ) -> Difference:
        topic = next(own.topic for own in (recorded, came_out) if own is not None)
        if recorded is None or came_out is None:
            one, other = (
                _NOTHING if own is None else str(own.value) for own in (recorded, came_out)
            )
            return Difference(self._agent, time_ns, topic, "", one, other)
        found = first_mismatch(recorded.value, came_out.value)
        assert found is not None
        shown = repr(found.recorded), repr(found.came_out)
        return Difference(self._agent, time_ns, topic, found.where, *shown)
