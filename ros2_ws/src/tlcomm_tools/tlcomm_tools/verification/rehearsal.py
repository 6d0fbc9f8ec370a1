"""One agent once more, in lock step with its own record.

``rehearse``  what it does at each instant
"""

from bisect import bisect_right
from collections import deque
from collections.abc import Iterator

from tlcomm_core.agent.member import Member
from tlcomm_core.world.observation import Odometry, Reading
from tlcomm_tools.verification.inputs import Inputs, Neighbours, Told
from tlcomm_tools.verification.outputs import Failure, Output, hearing_of, output_of
from tlcomm_tools.verification.recording import MapShown, Said

__all__ = ["rehearse"]


def rehearse(member: Member, inputs: Inputs, end_ns: int) -> Iterator[tuple[int, list[Output]]]:
    """Yield each instant at which an agent acts, and what it does then.

    Args:
        member: a fresh one.
        inputs: what it is told.
        end_ns: the last instant.

    Yields:
        If it fails, that is the last thing that it does.
    """
    told = deque(inputs.told)
    need_ns: int | None = 0
    now_ns = -1
    while (due_ns := _next_ns(inputs, now_ns, need_ns)) is not None and due_ns <= end_ns:
        now_ns = due_ns
        _tell_until(member, told, (now_ns, False))
        outputs = _act(member, now_ns)
        if now_ns in inputs.readings_ns:
            _tell_until(member, told, (now_ns, True))
            outputs += _act(member, now_ns)
        yield now_ns, outputs
        if any(isinstance(output.value, Failure) for output in outputs):
            return
        need_ns = member.next_need_ns


def _next_ns(inputs: Inputs, now_ns: int, need_ns: int | None) -> int | None:
    """Return the next instant at which the agent acts; ``None`` if there is none."""
    known = bisect_right(inputs.occasions_ns, now_ns)
    instants_ns = [*inputs.occasions_ns[known : known + 1], *([] if need_ns is None else [need_ns])]
    return min(instants_ns, default=None)


def _tell_until(member: Member, told: deque[Told], until: tuple[int, bool]) -> None:
    while told and (told[0].time_ns, told[0].is_after) <= until:
        _tell(member, told.popleft())


def _tell(member: Member, told: Told) -> None:
    match told.what:
        case Odometry(stamp_ns, _, pose, linear_mps, angular_radps):
            member.see_odometry(stamp_ns, pose, linear_mps, angular_radps)
        case Neighbours(stamp_ns, distances_m):
            member.see_neighbours(stamp_ns, distances_m)
        case MapShown(stamp_ns, free):
            member.see_map(stamp_ns, free)
        case Reading(stamp_ns, value=value):
            member.see_reading(stamp_ns, value)
        case Said(stamp_ns, _, message):
            member.receive(message, stamp_ns)


def _act(member: Member, now_ns: int) -> list[Output]:
    try:
        actions = member.step(now_ns)
    except Exception as error:  # noqa: BLE001 (whatever a brain fails with is what came out)
        return [Output("failure", Failure(f"{type(error).__name__}: {error}"))]
    outputs = map(output_of, actions)
    return [*hearing_of(member, now_ns), *(output for output in outputs if output is not None)]
