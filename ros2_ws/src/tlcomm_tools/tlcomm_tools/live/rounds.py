"""What was agreed on, as it comes about.

``Rounds``  told what agents do and say, it lists the rounds
"""

from collections import defaultdict
from dataclasses import dataclass, field
from typing import Any, Final

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_core.method import Method
from tlcomm_core.protocol.messages import BestResponse
from tlcomm_core.records import RunRecords, StrategyRecord, TaskRecord
from tlcomm_core.scenario.model import Scenario
from tlcomm_tools.live.growing import Growing
from tlcomm_tools.report.rounds import round_documents

__all__ = ["Rounds"]


@dataclass(slots=True)
class _Round:
    """What is known of all meetings of one number.

    Attributes:
        records: strategies held and arrivals.
        said: best responses, one of each agent's change in each iteration.
        places: where in the list each of its meetings is, by members.
    """

    records: RunRecords = field(default_factory=RunRecords)
    said: dict[tuple[int, str], BestResponse] = field(default_factory=dict)
    places: dict[tuple[str, ...], int] = field(default_factory=dict)


class Rounds:
    """Lists the rounds, in the order of agreement."""

    def __init__(self, listed: Growing, scenario: Scenario, method: Method) -> None:
        """Begin without any.

        Args:
            listed: to be filled.
            scenario: what is run.
            method: of coordination.
        """
        self._listed: Final = listed
        self._scenario: Final = scenario
        self._method: Final = method
        self._rounds: Final = defaultdict[int, _Round](_Round)
        # The numbers of which something is new, and those whose meeting is yet to begin.
        self._changed: set[int] = set()
        self._awaited: set[int] = set()

    def take_strategy(self, record: StrategyRecord) -> None:
        """Take what an agent holds as agreed."""
        self._rounds[record.strategy.round].records.strategies.append(record)
        self._changed.add(record.strategy.round)

    def take_event(self, record: TaskRecord) -> None:
        """Take what an agent did."""
        if record.event.kind is TaskEventKind.MEETING_REACHED:
            self._rounds[record.event.round].records.tasks.append(record)
            self._changed.add(record.event.round)

    def take_response(self, said: BestResponse) -> None:
        """Take what an agent told of a best response; what others repeat adds nothing."""
        key = said.iteration, said.candidate
        if key not in self._rounds[said.round].said:
            self._rounds[said.round].said[key] = said
            self._changed.add(said.round)

    def draw(self, end_s: float) -> None:
        """Bring the list up to date, up to a time."""
        changed, self._changed = self._changed | self._awaited, set()
        for number in sorted(changed):
            own = self._rounds[number]
            documents = round_documents(
                self._scenario, self._method, own.records, end_s, own.said.values()
            )
            for document in documents:
                self._list(own, document)
            self._awaited.discard(number)
            if any(map(_is_awaited, documents)):
                self._awaited.add(number)

    def _list(self, own: _Round, document: dict[str, Any]) -> None:
        members = tuple(member["agent"] for member in document["members"])
        items = self._listed.items
        place = own.places.setdefault(members, len(items))
        self._listed.replace(place, [document, *items[place + 1 :]])


def _is_awaited(document: dict[str, Any]) -> bool:
    """Return whether all have come, and their meeting hasn't begun."""
    arrived = all(own["arrival_s"] is not None for own in document["members"])
    return arrived and document["started_s"] is None
