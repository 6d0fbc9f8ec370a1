"""Every state that a team of real negotiations can get into, whatever the network does.

``Space``      the states of a team, and how one follows from another
``Explored``   what was found
``tiny_space`` a team of two to four that plans a round of few exchanges
``flaw``       what is wrong with a state, if anything

The network may deliver whatever a neighbour has ever said, at any time, in any order and any number
of times, and needn't deliver anything. That is every interleaving of delivery, loss, duplication,
delay and reordering, with no bound on any. Repetitions are said as soon as they can be: what is on
the network only grows, so nothing is ruled out by that. So a state is what each agent holds, and
the set of what has been said; a state whose agents are the same and whose network has less is left
out, since all that follows from it follows from the other too. An agent that has left or given up
is one that isn't looked at again, which is among these runs. What is finite is the round: its
offers, exchanges and confirmations.

A team of N agents has far fewer states of each agent than of the team. So real negotiations are
only copied and told something once for each of their own states; the team's are tuples of numbers.
"""

import copy
import math
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import islice

import numpy as np

from support.meetings import Meeting, sample_meeting
from tlcomm_core.game.solver import BEST_RESPONSE, Solver
from tlcomm_core.protocol.actions import Action, SendMessage
from tlcomm_core.protocol.messages import Message, PlanOffer
from tlcomm_core.protocol.negotiation import Negotiation
from tlcomm_core.protocol.whereabouts import Ending, Whereabouts
from tlcomm_core.world.radio import links, neighbours

__all__ = ["Explored", "Space", "flaw", "tiny_space"]

Team = tuple[int, ...]
Check = Callable[[list[Negotiation]], str | None]

_MACHINES = "tlcomm_core.protocol"
# What doesn't decide on anything: clocks, counts, and what is the same for all.
_LEFT_OUT = {"_next_need_s", "_retry_s", "_ignored", "_problem", "_rounds", "_team", "_is_sound"}
_FAIR_TURNS = 60
_MOST_DEAD_ENDS = 5


@dataclass(frozen=True, slots=True)
class Explored:
    """What was found.

    Attributes:
        team_states: how many states of the team, each with the most that may have been said.
        agent_states: how many different states of single agents.
        messages: how many different messages.
        transitions: how many deliveries and turns led from one state of the team to another.
        flaws: what is wrong, with how the team got there; empty if nothing is.
        is_complete: whether no state was left out for the limit's sake.
    """

    team_states: int
    agent_states: int
    messages: int
    transitions: int
    flaws: tuple[str, ...]
    is_complete: bool


def _frozen(value: object) -> Hashable:
    """Return all mutable state as something that is equal for equal states."""
    if isinstance(value, Mapping):
        return tuple(sorted((repr(key), _frozen(item)) for key, item in value.items()))
    if isinstance(value, AbstractSet):
        return frozenset(value)
    if isinstance(value, list | tuple):
        return tuple(_frozen(item) for item in value)
    if type(value).__module__.startswith(_MACHINES) and hasattr(value, "__dict__"):
        parts = sorted(vars(value).items())
        return tuple((name, _frozen(part)) for name, part in parts if name not in _LEFT_OUT)
    return value if isinstance(value, Hashable) else repr(value)


class Space:
    """The states of a team, and how one follows from another."""

    def __init__(self, meeting: Meeting, *, is_gathered: bool, is_prompt: bool) -> None:
        """Begin with everybody's arrival, or when everybody has heard all offers.

        Args:
            meeting: where, and what to plan.
            is_gathered: whether offers are known to all beforehand.
            is_prompt: whether each message is acted upon before the next is heard; otherwise any
                number may be heard before.
        """
        self._is_prompt = is_prompt
        self._meeting = meeting
        self._names = [offer.agent for offer in meeting.offers]
        places_m = np.array([(offer.x_m, offer.y_m) for offer in meeting.offers])
        near = neighbours(len(places_m), links(places_m, meeting.range_m))
        self._hears = [frozenset(self._names[node] for node in nodes) for nodes in near]
        self._agents: list[Negotiation] = []
        self._by_key: dict[Hashable, int] = {}
        self._messages: list[Message] = []
        self._by_message: dict[Message, int] = {}
        self._turns: list[tuple[int, int] | None] = []
        self._heard: list[dict[int, tuple[int, int]]] = []
        self._audible: list[int] = [0] * len(self._names)
        fresh = [
            Negotiation(offer, meeting.round, meeting.team, meeting.rounds)
            for offer in meeting.offers
        ]
        if is_gathered:
            for agent, near_by in zip(fresh, self._hears, strict=True):
                for name in sorted(near_by):
                    everyone = tuple(self._names)
                    agent.hear(PlanOffer(name, meeting.round, everyone, meeting.offers))
        self.start: Team = tuple(self._intern(agent) for agent in fresh)

    def explore(self, check: Check, most_states: int) -> Explored:
        """Visit every state of the team; check each.

        Args:
            check: what is wrong with the agents in a state, if anything.
            most_states: to visit at the most.
        """
        seen: dict[Team, list[int]] = {self.start: [0]}
        came_from: dict[Team, tuple[Team, str]] = {}
        waiting = [(self.start, 0)]
        states, transitions, flaws = 1, 0, list[str]()
        while waiting and states < most_states and not flaws:
            team, said = waiting.pop()
            if not any(said == known for known in seen[team]):
                continue  # The same agents were found with more said meanwhile.
            for index, after, now_said in self._successors(team, said):
                transitions += 1
                then = (*team[:index], after, *team[index + 1 :])
                masks = seen.get(then)
                if masks is None:
                    came_from[then] = (team, self._names[index])
                    wrong = check([self._agents[number] for number in then])
                    if wrong is not None:
                        flaws.append(f"{wrong}: {self._way_to(then, came_from)}")
                    masks = seen[then] = []
                if any(now_said | mask == mask for mask in masks):
                    continue
                masks[:] = [mask for mask in masks if mask | now_said != now_said]
                masks.append(now_said)
                states += 1
                waiting.append((then, now_said))
        flaws += islice(self._dead_ends(seen), _MOST_DEAD_ENDS) if not flaws else []
        return Explored(
            team_states=sum(map(len, seen.values())),
            agent_states=len(self._agents),
            messages=len(self._messages),
            transitions=transitions,
            flaws=tuple(flaws),
            is_complete=not waiting,
        )

    def _successors(self, team: Team, said: int) -> Iterator[tuple[int, int, int]]:
        """Yield which agent may change into what, and what has been said then."""
        for index, agent in enumerate(team):
            after, words = self._turn(agent)
            if after != agent or words | said != said:
                yield index, after, said | words
            for number in _bits(said & self._audible[index]):
                after, words = self._hear(agent, number)
                if after != agent:
                    yield index, after, said | words

    def _turn(self, agent: int) -> tuple[int, int]:
        """Return an agent's state after its turn, and what it says in it and then repeats."""
        known = self._turns[agent]
        if known is None:
            moved = self._copy(agent)
            known = self._turns[agent] = self._after_turn(moved)
        return known

    def _hear(self, agent: int, number: int) -> tuple[int, int]:
        """Return an agent's state after hearing a message, and what it says if it is prompt."""
        heard = self._heard[agent]
        if number not in heard:
            moved = self._copy(agent)
            moved.hear(self._messages[number])
            prompt = self._is_prompt
            heard[number] = self._after_turn(moved) if prompt else (self._intern(moved), 0)
        return heard[number]

    def _after_turn(self, agent: Negotiation) -> tuple[int, int]:
        """Let an agent take its turn; return its state, and what it says and repeats then."""
        words = [*agent.proceed(0.0)]
        if agent.next_need_s < math.inf:
            words += [SendMessage(message) for message in agent._repetitions()]
        return self._intern(agent), self._mask(words)

    def _copy(self, agent: int) -> Negotiation:
        return copy.deepcopy(self._agents[agent], dict(self._shared))

    @cached_property
    def _shared(self) -> dict[int, object]:
        """What needn't be copied, by its id, as ``copy.deepcopy`` wants it."""
        meeting = self._meeting
        common = (meeting.rounds, meeting.problem, meeting.team, *meeting.offers)
        return {id(each): each for each in common}

    def _intern(self, agent: Negotiation) -> int:
        key = _frozen(agent)
        number = self._by_key.setdefault(key, len(self._agents))
        if number == len(self._agents):
            self._agents.append(agent)
            self._turns.append(None)
            self._heard.append({})
        return number

    def _mask(self, actions: Iterable[Action]) -> int:
        """Return the set of messages that actions say, a bit for each."""
        mask = 0
        for action in actions:
            if isinstance(action, SendMessage):
                number = self._by_message.setdefault(action.message, len(self._messages))
                if number == len(self._messages):
                    self._messages.append(action.message)
                    for index, near in enumerate(self._hears):
                        self._audible[index] |= (action.message.sender in near) << number
                mask |= 1 << number
        return mask

    def _way_to(self, team: Team, came_from: Mapping[Team, tuple[Team, str]]) -> str:
        """Return who changed, in order, on a way to a state."""
        steps: list[str] = []
        while team in came_from:
            team, name = came_from[team]
            steps.append(name)
        return " ".join(reversed(steps))

    def _dead_ends(self, seen: Mapping[Team, object]) -> Iterator[str]:
        """Say from which states a network that loses nothing any more doesn't lead to agreement.

        Whatever was said before is lost; each turn everybody repeats what it can, and is heard.
        """
        live: set[Team] = set()
        for team in seen:
            path: list[Team] = []
            now = team
            while now not in live and len(path) <= _FAIR_TURNS:
                path.append(now)
                if all(self._agents[number].is_settled for number in now):
                    live.add(now)
                else:
                    now = self._fair_turn(now)
            if now not in live:
                yield f"no agreement within {_FAIR_TURNS} turns from {team}"
            else:
                live.update(path)

    def _fair_turn(self, team: Team) -> Team:
        """Let everybody say what it owes and repeat itself, and hear all of that and of answers."""
        after, said, fresh = [], 0, 0
        for agent in team:
            moved, words = self._turn(agent)
            after.append(moved)
            fresh |= words
        while fresh:
            said, heard, fresh = said | fresh, fresh, 0
            for index in range(len(after)):
                for number in _bits(heard & self._audible[index]):
                    after[index], words = self._hear(after[index], number)
                    fresh |= words & ~said
        return tuple(after)


def _bits(mask: int) -> Iterator[int]:
    """Yield the numbers of the bits that are set."""
    while mask:
        yield (mask & -mask).bit_length() - 1
        mask &= mask - 1


def tiny_space(
    shape: str,
    count: int,
    *,
    iterations: int = 1,
    is_gathered: bool = False,
    is_prompt: bool = False,
    solver: Solver = BEST_RESPONSE,
) -> Space:
    """Return the space of a team in a shape that plans a round in so many iterations at most."""
    meeting = sample_meeting(shape, count, 0, tasks=2, max_iterations=iterations)
    meeting = replace(meeting, team=replace(meeting.team, solver=solver))
    return Space(meeting, is_gathered=is_gathered, is_prompt=is_prompt)


def flaw(agents: list[Negotiation]) -> str | None:
    """Return what is wrong with a state of a team, if anything: safety, and the team's reunion."""
    confirmed = {agent.confirmed for agent in agents} - {None}
    agreed = {agent.agreed for agent in agents} - {None}
    if len(confirmed) > 1:
        return "two strategies are confirmed"
    if agreed and not agreed == confirmed == {agent.confirmed for agent in agents}:
        return "somebody has agreed though not all have confirmed the same"
    whereabouts = [
        Whereabouts((0.0, float(index))).after(0, _ending(agent), (1.0, float(index)))
        for index, agent in enumerate(agents)
    ]
    together = [len({own.place(window)[0] for own in whereabouts}) == 1 for window in (1, 2)]
    return None if any(together) else "the team is scattered for two windows"


def _ending(agent: Negotiation) -> Ending:
    """Return how the meeting ends for an agent that leaves in its state."""
    if agent.agreed is not None:
        return Ending.AGREED
    if agent.confirmed is not None:
        return Ending.DOUBTFUL
    return Ending.MISSED if agent.meeting_s is None else Ending.GATHERED
