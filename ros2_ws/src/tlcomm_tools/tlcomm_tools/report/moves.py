"""The moves of single agents by which a round's cost came down.

``Course``               the best responses that were said of a round
``courses``              those of all rounds
``read_best_responses``  what was said, from a bag
"""

from collections import defaultdict
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

from tlcomm_core.errors import InputError
from tlcomm_core.game.strategy import TeamStrategy
from tlcomm_core.protocol.messages import BestResponse, TeamMessage
from tlcomm_core.wire.team_messages import decode_message
from tlcomm_tools.bag.container import Channel
from tlcomm_tools.bag.messages import BagMessage, read_messages, using
from tlcomm_tools.bag.topics import AGENT_TOPICS

__all__ = ["Course", "courses", "read_best_responses"]

_TOPIC: Final = "best_response"
_DIGITS: Final = 3


@dataclass(frozen=True, slots=True)
class Course:
    """The best responses that were said of a round.

    Attributes:
        said: all of them.
    """

    said: tuple[BestResponse, ...] = ()

    def moves_to(self, strategy: TeamStrategy) -> list[dict[str, Any]] | None:
        """Return the moves that led to what was agreed; ``None`` if not all were recorded.

        Each has the agent that moved, its new place, its change of Φ, and Φ after it: in a
        potential game Φ changes by what the agent's own cost does.

        Source: Algorithm 1 of the paper; the least change of an iteration is made.
        """
        members = frozenset(strategy.members)
        best: dict[int, BestResponse] = {}
        for own in self.said:
            known = best.get(own.iteration, own)
            if own.sender in members and own.candidate in members:
                best[own.iteration] = min(known, own, key=lambda word: word.priority)
        made = [own for _, own in sorted(best.items()) if own.iteration < strategy.iteration]
        if len(made) != strategy.iteration:
            return None
        after_s = strategy.potential_s
        documents = []
        for own in reversed(made):
            documents.append(
                {
                    "agent": own.candidate,
                    "place_m": (own.strategy.x_m, own.strategy.y_m),
                    "change_s": round(own.change_s, _DIGITS),
                    "potential_s": round(after_s, _DIGITS),
                }
            )
            after_s -= own.change_s
        return documents[::-1]


def courses(said: Iterable[BestResponse]) -> Mapping[int, Course]:
    """Return what was said of each round."""
    by_round = defaultdict[int, list[BestResponse]](list)
    for own in said:
        by_round[own.round].append(own)
    return {number: Course(tuple(own)) for number, own in by_round.items()}


def read_best_responses(path: Path) -> tuple[BestResponse, ...]:
    """Return what agents said of their best responses, from a run's folder, a bag or a file.

    Raises:
        InputError: there is no bag, or a message can't be decoded or used.
    """
    messages = read_messages(path, _is_said).messages
    try:
        said = [_decoded(message) for message in messages]
    except InputError as error:
        raise InputError(f"{str(path)!r}: {error}") from error
    return tuple(own for own in said if isinstance(own, BestResponse))


def _decoded(message: BagMessage) -> TeamMessage:
    with using(message):
        said, _ = decode_message(message.content, _TOPIC)
    return said


def _is_said(channel: Channel) -> bool:
    is_topic = channel.topic.endswith(f"/{_TOPIC}")
    return is_topic and channel.type == AGENT_TOPICS[_TOPIC]
