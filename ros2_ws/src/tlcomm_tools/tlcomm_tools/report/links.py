"""Who heard whom, from when to when.

``link_spans``  the links of a run
``Links``       the same, as it goes on
"""

from collections.abc import Iterable, Iterator
from typing import Final

from tlcomm_core.units import seconds
from tlcomm_core.world.observation import Connectivity

__all__ = ["LinkSpan", "Links", "link_spans"]

# The agents' places in the team, and the times from and to which they were linked (s).
LinkSpan = tuple[int, int, float, float]

_DIGITS: Final = 3


def link_spans(seen: Iterable[Connectivity], team: int, end_s: float) -> list[LinkSpan]:
    """Return every link with its time, in the order of beginning.

    Args:
        seen: the radio graph at its changes, in order of time.
        team: how many agents there are; a link of any other is left out.
        end_s: when what is still linked is taken to end.
    """
    links = Links(team)
    for graph in seen:
        links.follow(graph)
    return sorted([*links.closed, *links.open(end_s)], key=lambda span: span[2])


class Links:
    """Follows the radio graph.

    Attributes:
        closed: the links that have ended, in the order of their ends.
    """

    def __init__(self, team: int) -> None:
        """Begin without any.

        Args:
            team: how many agents there are; a link of any other is left out.
        """
        self.closed: list[LinkSpan] = []
        self._team = team
        self._since_s: dict[tuple[int, int], float] = {}

    def follow(self, graph: Connectivity) -> None:
        """Take the graph from a time on."""
        now_s = round(seconds(graph.stamp_ns), _DIGITS)
        linked = {pair for pair in graph.edges if max(pair) < self._team}
        for pair in sorted(self._since_s.keys() - linked):
            start_s = self._since_s.pop(pair)
            if start_s < now_s:
                self.closed.append((*pair, start_s, now_s))
        self._since_s |= dict.fromkeys(sorted(linked - self._since_s.keys()), now_s)

    def open(self, end_s: float) -> Iterator[LinkSpan]:
        """Yield what is linked, as if it ended now."""
        for pair, start_s in self._since_s.items():
            if start_s < end_s:
                yield (*pair, start_s, end_s)
