"""The meetings that an agent has agreed to attend, where it meets one partner after another.

``Appointment``  one of them
``Prospect``     where an agent will be, and what it will have done, when it has nothing agreed
``Diary``        all that are ahead

A pair agrees on its next meeting when it meets, and each of the two attends others in between. So
an agent has several meetings ahead of it, and plans another from where the last of them leaves it.
"""

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, replace

from tlcomm_core.game.strategy import Strategy
from tlcomm_core.geometry import Pose

__all__ = ["Appointment", "Diary", "Prospect"]


@dataclass(frozen=True, slots=True)
class Appointment:
    """A meeting that an agent is to attend.

    Attributes:
        partner: whom it meets.
        window: in which.
        own: its own part: where to be, and after which step of its plan.
        meeting_s: t_c.
        pose: in which it will stand there.
    """

    partner: str
    window: int
    own: Strategy
    meeting_s: float
    pose: Pose


@dataclass(frozen=True, slots=True)
class Prospect:
    """Where an agent will be when nothing is agreed any more.

    Attributes:
        pose: in which it will stand.
        done: index of the last step that it will have done.
        free_s: when it will go on.
    """

    pose: Pose
    done: int
    free_s: float


class Diary:
    """The appointments ahead, in the order of their windows."""

    def __init__(self, duration_s: float) -> None:
        """Have none.

        Args:
            duration_s: how long each meeting lasts, D_c.
        """
        self._duration_s = duration_s
        self._ahead: deque[Appointment] = deque()

    @property
    def first(self) -> Appointment | None:
        """The next one, if there is any."""
        return self._ahead[0] if self._ahead else None

    def add(self, appointment: Appointment) -> None:
        """Note an appointment in a later window than all others."""
        assert not self._ahead or self._ahead[-1].window < appointment.window
        self._ahead.append(appointment)

    def take(self) -> Appointment:
        """Return the next one, and have it ahead no more."""
        return self._ahead.popleft()

    def prospect(self, now: Prospect) -> Prospect:
        """Return where the agent will be after all appointments.

        Args:
            now: the same if there are none.
        """
        if not self._ahead:
            return now
        last = self._ahead[-1]
        return Prospect(last.pose, last.own.task_index, last.meeting_s + self._duration_s)

    def stand(self, pose_at: Callable[[Appointment], Pose]) -> None:
        """Take it that the agent will stand in other poses at its meetings."""
        self._ahead = deque(replace(own, pose=pose_at(own)) for own in self._ahead)

    def postpone(self, steps: int) -> None:
        """Keep all places and times, but attend each after so many steps of the plan less.

        An agent that couldn't do all that it was to do before a meeting does that first. So as many
        steps as agreed are between its meetings, and others than agreed.

        Args:
            steps: how many the agent lags behind; or, if its plan is another, behind its old index.
        """
        self._ahead = deque(
            replace(own, own=replace(own.own, task_index=own.own.task_index - steps))
            for own in self._ahead
        )
