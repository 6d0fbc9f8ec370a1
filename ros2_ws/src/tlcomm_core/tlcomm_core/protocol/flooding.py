"""Knowledge that grows: items flooded through neighbours until everyone holds them all.

``Flood``  what this agent holds, and what it knows that its neighbours hold

Both halves of the protocol that end when *everybody* is known — who is present, who has
confirmed — are this: a set that only grows, told to neighbours, relayed by them. An item reaches
every member of a connected team after at most as many exchanges as the graph's diameter, whatever
the order, and hearing one twice changes nothing; so late, duplicate and reordered messages are
harmless by construction, and loss is mended by telling a neighbour again what it doesn't show.
"""

from collections.abc import Collection, Iterable, Mapping
from typing import Generic, TypeVar

__all__ = ["Flood"]

Item = TypeVar("Item")


class Flood(Generic[Item]):
    """One agent's part in flooding one item per member of the team."""

    def __init__(self, team: Iterable[str], own: str, item: Item) -> None:
        """Begin with nothing but one's own item."""
        self._team = frozenset(team)
        self._held: dict[str, Item] = {own: item}
        self._shown: dict[str, frozenset[str]] = {}

    @property
    def held(self) -> Mapping[str, Item]:
        """The items held, by their owners."""
        return self._held

    @property
    def known(self) -> tuple[str, ...]:
        """Owners of the items held, sorted."""
        return tuple(sorted(self._held))

    @property
    def is_complete(self) -> bool:
        """Whether every member's item is held."""
        return len(self._held) == len(self._team)

    def learn(
        self, sender: str, known: Collection[str], items: Mapping[str, Item]
    ) -> frozenset[str] | None:
        """Take in what a neighbour told.

        Args:
            sender: the neighbour.
            known: owners of the items that it holds; what it showed before isn't forgotten.
            items: the items told. Of an item held already, the first version stays.

        Returns:
            Owners of the items to tell now: those new here and, to a sender that asks, those that
            it hasn't shown. ``None`` if all of it was known, and nothing changed.
        """
        before = self._shown.get(sender)
        # Who speaks for the first time may have missed what was said before; who shows nothing
        # new repeats itself because something is missing. What others lack is on its way.
        asks = before is None or before.issuperset(known)
        self._shown[sender] = shown = (before or frozenset()).union(known)
        fresh = frozenset(items) - self._held.keys()
        for owner in sorted(fresh):
            self._held[owner] = items[owner]
        told = fresh | self.lacking(sender) if asks else fresh
        return told if told or shown != before else None

    def lacking(self, *neighbours: str) -> frozenset[str]:
        """Return owners of the items held here that some neighbour hasn't shown to hold."""
        shown = (self._shown.get(name, frozenset()) for name in neighbours)
        return frozenset().union(*(self._held.keys() - items for items in shown))

    def lacking_anywhere(self) -> frozenset[str]:
        """Return the same of all neighbours heard so far."""
        return self.lacking(*self._shown)

    def is_shown_complete_by(self, neighbours: Iterable[str]) -> bool:
        """Return whether each of ``neighbours`` has shown that it holds every member's item."""
        return all(self._shown.get(name, frozenset()) >= self._team for name in neighbours)
