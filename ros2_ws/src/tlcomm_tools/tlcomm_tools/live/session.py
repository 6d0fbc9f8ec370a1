"""From what is heard to what pages are told.

``Session``  a view's whole work, without ROS and without a network
"""

import json
from collections.abc import Iterable, Sequence
from pathlib import Path
from typing import Final

from rosbags.typesys.store import Typestore

from tlcomm_tools.bag.topics import Topic
from tlcomm_tools.live.beginning import Beginning
from tlcomm_tools.live.document import LiveDocument
from tlcomm_tools.live.growing import Edit
from tlcomm_tools.live.intake import Heard, Intake

__all__ = ["Session"]

# After so many turns in which all topics are heard, they have been heard for a while.
_TURNS_HEARD: Final = 3


class Session:
    """A view's whole work, without ROS and without a network."""

    def __init__(
        self, document: LiveDocument, topics: Sequence[Topic], store: Typestore, bag: Path
    ) -> None:
        """Begin before the run.

        Args:
            document: to be filled.
            topics: a topic's place in this sequence is its number.
            store: their types.
            bag: the bag's folder, for what was said before anything was heard.
        """
        self._document: Final = document
        self._intake: Final = Intake(document, topics, store)
        self._beginning: Final = Beginning(bag, topics)
        self._has_begun = False
        self._has_chosen = False
        self._turns_heard = 0

    def take(self, heard: Sequence[Heard], *, is_hearing: bool) -> None:
        """Take what was heard since the last call.

        Args:
            heard: in the order of arrival.
            is_hearing: whether every topic is heard.
        """
        if self._has_begun:
            self._take_in(heard)
            return
        self._beginning.hear(heard)
        if not self._has_chosen:
            self._has_chosen = self._turns_heard >= _TURNS_HEARD and self._beginning.choose(heard)
            self._turns_heard = self._turns_heard + 1 if is_hearing else 0
        elif (joined := self._beginning.join()) is not None:
            self._take_in(joined)
            self._has_begun = True

    def end(self, verdict: str | list[str]) -> None:
        """Take that the run is over, and what it says of itself."""
        if not self._has_begun:
            self._take_in(self._beginning.join_all())
            self._has_begun = True
        self._document.end(verdict)

    def news(self) -> str:
        """Return what is new since the last call, for pages; "" if nothing is."""
        edits = self._document.news()
        return _text(edits) if edits else ""

    def whole(self) -> str:
        """Return all that there is, for a page that knows nothing."""
        return _text(self._document.whole())

    def _take_in(self, heard: Iterable[Heard]) -> None:
        for own in heard:
            self._intake.take(own)


def _text(edits: Iterable[Edit]) -> str:
    return json.dumps(list(edits), allow_nan=False, ensure_ascii=False, separators=(",", ":"))
