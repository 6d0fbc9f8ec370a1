"""What the sim says to whom and when, without ROS: facts in, requests out.

``Conductor``  what both paces share: begin, take commands and answers, end
``RECORDER``   the recorder's name in answers
"""

from abc import ABC, abstractmethod
from collections.abc import Iterable, Sequence
from typing import Final

from tlcomm_sim.ledger import Ledger
from tlcomm_sim.outputs import Answer, Leave, Output, TickAgent, TickRecorder

__all__ = ["RECORDER", "Conductor"]

RECORDER: Final = "recorder"


class Conductor(ABC):
    """What both paces share: the end of a run, and the recorder's ticks.

    The end: every agent is told, and answers with its last counts; then the recorder is told, and
    answers when it has everything; then the sim leaves.
    """

    def __init__(self, agents: Sequence[str], *, has_recorder: bool) -> None:
        """Be ready to begin.

        Args:
            agents: in the scenario's order.
            has_recorder: whether a recorder takes part.
        """
        self._agents: Final = tuple(agents)
        self._has_recorder: Final = has_recorder
        self._ledger: Final = Ledger(agents)
        self._sequence = 0
        self._awaited: dict[str, int] = {}
        self._is_ending = False
        self._is_closing = False

    @property
    @abstractmethod
    def time_ns(self) -> int:
        """Simulated time."""

    @property
    @abstractmethod
    def meetings_ended(self) -> int:
        """How many meetings have ended for all agents."""

    @abstractmethod
    def begin(self, wall_ns: int) -> list[Output]:
        """Start the run; everybody is ready.

        Args:
            wall_ns: any steady clock, the same in all calls.
        """

    @abstractmethod
    def pass_time(self, wall_ns: int) -> list[Output]:
        """Note that wall time has passed."""

    @abstractmethod
    def take_command(
        self, agent: str, linear_mps: float, angular_radps: float, wall_ns: int
    ) -> list[Output]:
        """Take an agent's velocity command."""

    @abstractmethod
    def take_answer(self, answer: Answer) -> list[Output]:
        """Take an answer; those to other ticks than the last to the sender change nothing."""

    @property
    def awaited(self) -> tuple[str, ...]:
        """Who has been ticked and hasn't answered, by name."""
        return tuple(self._awaited)

    @property
    def sequence(self) -> int:
        """Number of the last tick."""
        return self._sequence

    def _noted(self, outputs: Iterable[Output]) -> list[Output]:
        """Count what is going to be published."""
        listed = list(outputs)
        for output in listed:
            self._ledger.note(output)
        return listed

    def _next_sequence(self) -> int:
        self._sequence += 1
        return self._sequence

    def _is_answer(self, answer: Answer) -> bool:
        """Tell whether somebody awaited has answered, and if so await it no more."""
        if self._awaited.get(answer.name) != answer.sequence:
            return False
        del self._awaited[answer.name]
        return True

    def _tick_recorder(
        self, time_ns: int, *, without: Iterable[Output] = (), stop: bool = False
    ) -> Output:
        """Tell the recorder how much has been published up to a time.

        Args:
            time_ns: the time.
            without: what has been published already, and is later.
            stop: whether this is the end.
        """
        sequence = self._next_sequence()
        self._awaited[RECORDER] = sequence
        return TickRecorder(self._ledger.recorder_tick(sequence, time_ns, without, stop=stop))

    def _end(self, arrived: Sequence[int]) -> list[Output]:
        """Tell every agent that the run is over."""
        self._is_ending = True
        outputs: list[Output] = []
        for agent in self._agents:
            sequence = self._next_sequence()
            self._awaited[agent] = sequence
            tick = self._ledger.agent_tick(agent, sequence, self.time_ns, arrived, stop=True)
            outputs.append(TickAgent(agent, tick))
        return outputs

    def _take_last_answer(self, answer: Answer) -> list[Output]:
        """Take an answer after the end: of agents, then of the recorder, then all is done."""
        if not self._is_answer(answer):
            return []
        if answer.name != RECORDER:
            self._ledger.note_agent(answer.name, answer.published)
        if self._awaited:
            return []
        if self._has_recorder and not self._is_closing:
            self._is_closing = True
            return [self._tick_recorder(self.time_ns, stop=True)]
        return [Leave()]
