"""Parts of a document that change, and what is new in them.

``Edit``     a change of one part, ready for JSON
``Part``     any of the two below
``Growing``  a list that grows at its end, where the last items may still change
``Value``    a value that is replaced
"""

from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, Final, Protocol, TypeVar

__all__ = ["Edit", "Growing", "Part", "Value"]

# path: the keys that lead to the part. Then either value: what it is now; or items: what the list
# has from the index "from" on.
Edit = dict[str, Any]

Key = str | int

_T = TypeVar("_T")


class Part(Protocol):
    """A part of a document."""

    def news(self) -> Iterator[Edit]:
        """Yield what has changed since the last call."""
        ...

    def whole(self) -> Iterator[Edit]:
        """Yield all of it, whatever was told before."""
        ...


class Growing:
    """A list that grows at its end, where the last items may still change.

    Attributes:
        items: the list.
    """

    def __init__(self, *path: Key, columns: Sequence[str] = ()) -> None:
        """Begin empty.

        Args:
            path: where it is in the document.
            columns: if given, there is an object with a list for each of these instead, and items
                are rows.
        """
        self.items: list[Any] = []
        self._path: Final = path
        self._columns: Final = tuple(columns)
        # The first so many are as they were told, and there were so many.
        self._same = 0
        self._told = 0
        self._closed = 0

    def append(self, item: Any) -> None:  # noqa: ANN401 - anything that JSON has
        """Add an item."""
        self.items.append(item)

    def replace(self, start: int, items: Sequence[Any]) -> None:
        """Let these be the items from an index on."""
        pairs = zip(self.items[start:], items, strict=False)
        same = next(
            (number for number, (known, item) in enumerate(pairs) if known != item),
            min(len(self.items) - start, len(items)),
        )
        self.items[start + same :] = items[same:]
        self._same = min(self._same, start + same)

    def close(
        self,
        closed: Sequence[_T],
        open_: Iterable[_T],
        draw: Callable[[_T], Any] = lambda item: item,
    ) -> None:
        """Let these be the items: what has ended, then what goes on.

        Args:
            closed: what has ended; at each call the same and more.
            open_: what goes on; at each call anew.
            draw: makes an item of it.
        """
        self.replace(self._closed, [draw(own) for own in (*closed[self._closed :], *open_)])
        self._closed = len(closed)

    def news(self) -> Iterator[Edit]:
        """Yield what has changed since the last call."""
        if self._same == self._told == len(self.items):
            return
        yield from self._edits(self._same)
        self._same = self._told = len(self.items)

    def whole(self) -> Iterator[Edit]:
        """Yield all of it, whatever was told before."""
        return self._edits(0)

    def _edits(self, start: int) -> Iterator[Edit]:
        items = self.items[start:]
        if not self._columns:
            yield {"path": self._path, "from": start, "items": items}
        for number, name in enumerate(self._columns):
            column = [row[number] for row in items]
            yield {"path": (*self._path, name), "from": start, "items": column}


class Value:
    """A value that is replaced.

    Attributes:
        value: what it is now.
    """

    def __init__(self, *path: Key, value: Any) -> None:  # noqa: ANN401 - anything that JSON has
        """Begin with what the document begins with.

        Args:
            path: where it is in the document.
            value: what it is there.
        """
        self.value = value
        self._path: Final = path
        self._told = value

    def news(self) -> Iterator[Edit]:
        """Yield it, if it has changed since the last call."""
        if self.value != self._told:
            self._told = self.value
            yield from self.whole()

    def whole(self) -> Iterator[Edit]:
        """Yield it, whatever was told before."""
        yield {"path": self._path, "value": self.value}
