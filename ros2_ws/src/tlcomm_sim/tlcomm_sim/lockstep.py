"""The sim in lock step.

``LockStepConductor``  ticks agents, waits for their answers and commands, and lets time go on
"""

from collections.abc import Sequence
from typing import Final

from tlcomm_core.world.lockstep import LockStep, Reply, Step
from tlcomm_sim.conductor import RECORDER, Conductor
from tlcomm_sim.outputs import Answer, Output, Show, ShowClock, TickAgent

__all__ = ["LockStepConductor"]

_CLOCK_NS: Final = 100_000_000

# Recorded messages between two ticks of the recorder. The run goes on while it answers, and waits
# only when the next lot is full too: so at most two lots are under way, fewer messages than one
# publisher's history holds.
_LOT: Final = 300
# A slow run ticks it before that, by wall time: what it hasn't been ticked for isn't in the bag.
_RECORDER_WAITS_NS: Final = 200_000_000

# After so many requests the shell has its turn, even if nobody needs to be waited for.
_BATCH: Final = 1000


class LockStepConductor(Conductor):
    """Ticks agents, waits for their answers and commands, and lets time go on.

    The clock is shown at the multiples of 0.1 s, each before anything later.
    """

    def __init__(self, lockstep: LockStep, agents: Sequence[str], *, has_recorder: bool) -> None:
        """Be ready to begin at t = 0."""
        super().__init__(agents, has_recorder=has_recorder)
        self._lockstep: Final = lockstep
        self._step: Step | None = None
        self._arrived: tuple[int, ...] = ()
        self._answers: dict[str, Answer] = {}
        self._commands = dict.fromkeys(self._agents, 0)
        self._commands_used = dict.fromkeys(self._agents, 0)
        self._last_command = dict.fromkeys(self._agents, (0.0, 0.0))
        self._clock_ns = 0
        self._ticked_total = 0
        self._ticked_wall_ns = 0
        self._settled_ns = 0
        self._later: list[Output] = []

    @property
    def time_ns(self) -> int:
        """Simulated time of the last step."""
        return self._lockstep.time_ns

    @property
    def meetings_ended(self) -> int:
        """How many meetings have ended for all agents."""
        return self._lockstep.meetings_ended

    @property
    def awaited(self) -> tuple[str, ...]:
        """Who hasn't answered, or has answered before all its commands have arrived."""
        late = [name for name in self._answers if not self._has_commands_of(name)]
        return (*self._awaited, *late)

    def begin(self, wall_ns: int) -> list[Output]:
        """Take the first step; everybody is ready."""
        self._ticked_wall_ns = wall_ns
        return self._proceed()

    def pass_time(self, wall_ns: int) -> list[Output]:
        """Go on where a batch ended; wall time itself means something to the recorder only."""
        return [*self._tick_recorder_in_time(wall_ns), *self._proceed()]

    def take_command(
        self, agent: str, linear_mps: float, angular_radps: float, wall_ns: int
    ) -> list[Output]:
        """Take a velocity command; the last one of a tick counts."""
        del wall_ns
        self._commands[agent] += 1
        self._last_command[agent] = (linear_mps, angular_radps)
        return self._proceed()

    def take_answer(self, answer: Answer) -> list[Output]:
        """Take an answer; those to other ticks than the last to the sender change nothing."""
        if self._is_ending:
            return self._take_last_answer(answer)
        if self._is_answer(answer) and answer.name != RECORDER:
            self._answers[answer.name] = answer
        return self._proceed()

    def _proceed(self) -> list[Output]:
        outputs: list[Output] = []
        while len(outputs) < _BATCH and not self._must_wait():
            outputs += self._advance() if self._step is None else self._complete(self._step)
        return outputs

    def _must_wait(self) -> bool:
        if self._is_ending or any(name != RECORDER for name in self.awaited):
            return True
        return self._is_lot_full() and RECORDER in self._awaited

    def _is_lot_full(self) -> bool:
        return self._has_recorder and self._ledger.total - self._ticked_total >= _LOT

    def _tick_recorder_in_time(self, wall_ns: int) -> list[Output]:
        """While agents take their time, tick the recorder of what was published before this step.

        Of the second step at one time nothing is said: what was published in the first is of that
        time, too.
        """
        published = self._ledger.total - len(self._later)
        is_due = (
            self._has_recorder
            and RECORDER not in self._awaited
            and self._step is not None
            and self._settled_ns < self._step.time_ns
            and published > self._ticked_total
            and wall_ns - self._ticked_wall_ns >= _RECORDER_WAITS_NS
        )
        if not is_due:
            return []
        self._ticked_wall_ns = wall_ns
        self._ticked_total = published
        return [self._tick_recorder(self._settled_ns, without=self._later)]

    def _advance(self) -> list[Output]:
        """Go to the next instant, or to the end."""
        outputs: list[Output] = []
        self._settled_ns = self.time_ns
        step = self._lockstep.next_step()
        if step is None:
            return self._end(self._arrived)
        if self._is_lot_full() and self._settled_ns < step.time_ns:
            self._ticked_total = self._ledger.total
            outputs.append(self._tick_recorder(self._settled_ns))
        self._step = step
        self._arrived = step.arrived
        self._later = self._noted(self._clocks_until(step.time_ns))
        self._later += self._noted(Show(observation) for observation in step.observations)
        outputs += self._later
        outputs += [self._tick(agent, step) for agent in step.ticked]
        return outputs

    def _complete(self, step: Step) -> list[Output]:
        """Hand the answers over."""
        replies = {agent: self._reply_of(agent) for agent in step.ticked}
        self._answers.clear()
        self._step = None
        return self._noted(Show(observation) for observation in self._lockstep.complete(replies))

    def _tick(self, agent: str, step: Step) -> Output:
        sequence = self._next_sequence()
        self._awaited[agent] = sequence
        tick = self._ledger.agent_tick(agent, sequence, step.time_ns, step.arrived)
        return TickAgent(agent, tick)

    def _reply_of(self, agent: str) -> Reply:
        answer = self._answers[agent]
        self._ledger.note_agent(agent, answer.published)
        is_new = self._commands[agent] > self._commands_used[agent]
        self._commands_used[agent] = self._commands[agent]
        return Reply(
            next_need_ns=answer.next_need_ns,
            team_messages=answer.team_messages,
            command=self._last_command[agent] if is_new else None,
            meetings_ended=answer.meetings_ended,
            measured_at=answer.measured_at,
        )

    def _has_commands_of(self, agent: str) -> bool:
        return self._commands[agent] >= self._answers[agent].commands

    def _clocks_until(self, time_ns: int) -> list[ShowClock]:
        clocks = [ShowClock(t) for t in range(self._clock_ns, time_ns + 1, _CLOCK_NS)]
        self._clock_ns += len(clocks) * _CLOCK_NS
        return clocks
