"""Another task for a running agent: what the service ``change_task`` answers.

``Answer``       whether the task is taken on, and from when, or why not
``change_task``  gives it to the agent
"""

from typing import NamedTuple

from tlcomm_core.agent.member import Member
from tlcomm_core.errors import InputError, PlanningError

__all__ = ["IN_LOCKSTEP", "Answer", "change_task"]


class Answer(NamedTuple):
    """The fields of the service's response."""

    accepted: bool
    message: str


IN_LOCKSTEP = Answer(
    accepted=False,
    message="in lock step a run depends on nothing from outside: change tasks when running freely",
)


def change_task(member: Member, task: str, now_ns: int) -> Answer:
    """Let an agent plan for another task; without a plan the old one goes on.

    Args:
        member: the agent.
        task: its formula's text.
        now_ns: the simulated time.
    """
    try:
        plan = member.change_task(task, now_ns)
    except (InputError, PlanningError) as error:
        return Answer(accepted=False, message=str(error))
    steps = f"{len(plan.prefix)} steps, then {len(plan.suffix)} again and again"
    message = f"from the next meeting on: {steps}, in {plan.suffix_s:.1f} s"
    return Answer(accepted=True, message=message)
