"""The sim with a clock that runs freely, at a factor of real time.

``FreeRunConductor``  lets the world follow the wall clock
"""

from collections.abc import Iterable, Sequence
from typing import Final

from tlcomm_core.world.lockstep import StopRule
from tlcomm_core.world.observation import Observation, Odometry
from tlcomm_core.world.world import World
from tlcomm_sim.conductor import RECORDER, Conductor
from tlcomm_sim.outputs import Answer, Output, Show, ShowClock, Warn

__all__ = ["FreeRunConductor"]

_ODOMETRY_NS: Final = 50_000_000

# A sim that wasn't run for longer than this lets simulated time slip instead of catching up in one
# leap, which no controller could follow.
_LONGEST_PAUSE_NS: Final = 250_000_000
_WARNED_SLIP_NS: Final = 500_000_000


class FreeRunConductor(Conductor):
    """Lets the world follow the wall clock.

    Besides what the world shows by itself, moving agents' odometry is shown at 20 Hz.
    """

    def __init__(
        self,
        world: World,
        agents: Sequence[str],
        stop: StopRule,
        factor: float,
        *,
        has_recorder: bool,
    ) -> None:
        """Be ready to begin at t = 0.

        Args:
            world: at t = 0.
            agents: in the scenario's order.
            stop: when the run is over.
            factor: simulated time per wall time.
            has_recorder: whether a recorder takes part.
        """
        super().__init__(agents, has_recorder=has_recorder)
        self._world: Final = world
        self._stop: Final = stop
        self._factor: Final = factor
        self._meetings_ended = dict.fromkeys(self._agents, 0)
        self._wall_ns = 0
        self._elapsed_wall_ns = 0
        self._slipped_ns = 0
        self._warned_ns = 0
        self._odometry_ns = 0

    @property
    def time_ns(self) -> int:
        """Simulated time."""
        return self._world.now_ns

    @property
    def meetings_ended(self) -> int:
        """How many meetings have ended for all agents."""
        return min(self._meetings_ended.values())

    def begin(self, wall_ns: int) -> list[Output]:
        """Start the clock; everybody is ready."""
        self._wall_ns = wall_ns
        return self._noted([ShowClock(0), *_shown(self._world.advance_to(0))])

    def pass_time(self, wall_ns: int) -> list[Output]:
        """Let the world go on to where the wall clock is, and show the clock."""
        if self._is_ending:
            return []
        outputs = self._follow(wall_ns)
        outputs.append(ShowClock(self.time_ns))
        if self.time_ns >= self._odometry_ns + _ODOMETRY_NS:
            self._odometry_ns = self.time_ns
            outputs += _shown(self._moving(outputs))
        outputs = self._noted(outputs) + self._warn()
        return outputs + self._end([0] * len(self._agents)) if self._is_over() else outputs

    def take_command(
        self, agent: str, linear_mps: float, angular_radps: float, wall_ns: int
    ) -> list[Output]:
        """Carry a velocity command out at once."""
        if self._is_ending:
            return []
        outputs = self._follow(wall_ns)
        outputs += _shown(self._world.command(agent, linear_mps, angular_radps))
        return self._noted(outputs)

    def take_answer(self, answer: Answer) -> list[Output]:
        """Note how far an agent has come, and whether it has measured."""
        is_agent = answer.name != RECORDER and answer.name in self._meetings_ended
        if is_agent:
            self._meetings_ended[answer.name] = answer.meetings_ended
        if self._is_ending:
            return self._take_last_answer(answer)
        if not (is_agent and answer.measured_at):
            return []
        return self._noted(_shown(self._world.measure(answer.name, answer.measured_at)))

    def _follow(self, wall_ns: int) -> list[Output]:
        """Advance the world, stopping at each of its own changes."""
        passed_ns = max(0, wall_ns - self._wall_ns)
        self._wall_ns += passed_ns
        self._elapsed_wall_ns += min(passed_ns, _LONGEST_PAUSE_NS)
        self._slipped_ns += max(0, passed_ns - _LONGEST_PAUSE_NS)
        target_ns = max(self.time_ns, round(self._elapsed_wall_ns * self._factor))
        if self._stop.until_ns is not None:
            target_ns = min(target_ns, self._stop.until_ns)
        outputs: list[Output] = []
        while (change_ns := self._world.next_change_ns()) < target_ns:
            outputs += _shown(self._world.advance_to(change_ns))
        return outputs + _shown(self._world.advance_to(target_ns))

    def _moving(self, outputs: Iterable[Output]) -> list[Odometry]:
        """Return the odometry of those that move and haven't just been shown."""
        shown = {
            (output.observation.agent, output.observation.stamp_ns)
            for output in outputs
            if isinstance(output, Show) and isinstance(output.observation, Odometry)
        }
        current = [self._world.odometry(agent) for agent in self._agents]
        return [
            odometry
            for odometry in current
            if (odometry.linear_mps or odometry.angular_radps)
            and (odometry.agent, odometry.stamp_ns) not in shown
        ]

    def _warn(self) -> list[Output]:
        if self._slipped_ns - self._warned_ns < _WARNED_SLIP_NS:
            return []
        self._warned_ns = self._slipped_ns
        text = f"the sim can't keep pace: {self._slipped_ns * 1e-9:.1f} s of wall time lost so far"
        return [Warn(text)]

    def _is_over(self) -> bool:
        stop = self._stop
        if stop.until_ns is not None and self.time_ns >= stop.until_ns:
            return True
        return stop.meetings is not None and self.meetings_ended >= stop.meetings


def _shown(observations: Iterable[Observation]) -> list[Output]:
    return [Show(observation) for observation in observations]
