"""Who heard whom, from when to when.

``link_spans``  the links of a run
"""

from collections.abc import Iterable
from typing import Final

from tlcomm_core.units import seconds
from tlcomm_core.world.observation import Connectivity

__all__ = ["LinkSpan", "link_spans"]

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
    since_s: dict[tuple[int, int], float] = {}
    spans: list[LinkSpan] = []
    for graph in seen:
        now_s = round(seconds(graph.stamp_ns), _DIGITS)
        linked = {pair for pair in graph.edges if max(pair) < team}
        spans += [(*pair, since_s.pop(pair), now_s) for pair in sorted(since_s.keys() - linked)]
        since_s |= dict.fromkeys(sorted(linked - since_s.keys()), now_s)
    spans += [(*pair, start_s, end_s) for pair, start_s in since_s.items()]
    return sorted((span for span in spans if span[2] < span[3]), key=lambda span: span[2])
