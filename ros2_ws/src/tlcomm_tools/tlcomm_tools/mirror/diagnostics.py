"""How a team is, as ``diagnostic_msgs/DiagnosticArray``.

``make_diagnostics``  planner, game, radio, window, and each agent

STALE is what hasn't been heard of for a while or at all, so nothing is known of it now.
"""

from collections.abc import Iterator, Mapping
from enum import IntEnum
from typing import Final

from rosbags.typesys.stores import ros2_jazzy as ros

from tlcomm_core.agent.actions import Fault
from tlcomm_core.records import StrategyRecord, TaskRecord
from tlcomm_core.units import nanoseconds, seconds
from tlcomm_tools.mirror.elements import make_header
from tlcomm_tools.mirror.picture import AgentPicture, Picture

__all__ = ["Level", "make_diagnostics"]


class Level(IntEnum):
    """The levels of ``diagnostic_msgs/DiagnosticStatus``."""

    OK = 0
    WARN = 1
    ERROR = 2
    STALE = 3


_Status = ros.diagnostic_msgs__msg__DiagnosticStatus

# Poses and links are told once a second at least.
_SILENT_NS: Final = nanoseconds(3.0)
# For how long a fault that has been coped with is shown.
_RECENT_NS: Final = nanoseconds(10.0)
# Of T_c: a window that has no more than that left, and no meeting, is short of time.
_LITTLE: Final = 0.05
_GRAVE: Final = tuple(f"{fault}=" for fault in (Fault.BLOCKED, Fault.INFEASIBLE))


def make_diagnostics(picture: Picture, now_ns: int) -> ros.diagnostic_msgs__msg__DiagnosticArray:
    """Return how all is by now."""
    picture.windows.advance(now_ns)
    team = (_planner(picture, now_ns), _game(picture), _radio(picture, now_ns))
    window = (_window(picture, now_ns),) if picture.method.keeps_windows else ()
    return ros.diagnostic_msgs__msg__DiagnosticArray(
        make_header(now_ns), [*team, *window, *_agents(picture, now_ns)]
    )


def _status(
    name: str,
    level: Level,
    message: str,
    values: Mapping[str, object],
    hardware: str = "team",
) -> _Status:
    pairs = [
        ros.diagnostic_msgs__msg__KeyValue(key, _text_of(value)) for key, value in values.items()
    ]
    return _Status(int(level), f"tlcomm: {name}", message, hardware, pairs)


def _text_of(value: object) -> str:
    """Return a number as one; plotters read them from the text."""
    if isinstance(value, bool):
        return str(int(value))
    return f"{value:.3f}" if isinstance(value, float) else str(value)


def _planner(picture: Picture, now_ns: int) -> _Status:
    """Return how the execution of plans goes: the gravest of the recent faults."""
    agents = picture.agents.values()
    satisfied = sum(agent.satisfied for agent in agents)
    values = {"tasks_satisfied": satisfied}
    if all(agent.event is None for agent in agents):
        return _status("planner", Level.STALE, "nothing done yet", values)
    faults = [fault for agent in agents if (fault := _recent_fault(agent, now_ns)) is not None]
    grave = [fault for fault in faults if fault.event.detail.startswith(_GRAVE)]
    if grave or faults:
        worst = (grave or faults)[0]
        level = Level.ERROR if grave else Level.WARN
        return _status("planner", level, f"{worst.agent}: {worst.event.detail}", values)
    return _status("planner", Level.OK, "all follow their plans", values)


def _recent_fault(agent: AgentPicture, now_ns: int) -> TaskRecord | None:
    fault = agent.fault
    if fault is None or now_ns - fault.stamp_ns > _RECENT_NS:
        return None
    return fault


def _game(picture: Picture) -> _Status:
    """Return whether those who hold a strategy for the latest round hold the same."""
    held = [agent.held for agent in picture.agents.values() if agent.held is not None]
    if not held:
        return _status("game", Level.STALE, "nothing agreed yet", {})
    if not picture.method.meets_in_windows:
        return _status("game", Level.OK, "by the method's own turns", {})
    latest = max(own.strategy.round for own in held)
    current = [own for own in held if own.strategy.round == latest]
    values = _game_values(current)
    if any(own.strategy != current[0].strategy for own in current):
        return _status("game", Level.ERROR, f"round {latest}: strategies differ", values)
    if len(current) < len(picture.agents):
        missing = len(picture.agents) - len(current)
        return _status("game", Level.WARN, f"round {latest}: {missing} haven't agreed", values)
    return _status("game", Level.OK, f"round {latest}: agreed", values)


def _game_values(current: list[StrategyRecord]) -> dict[str, object]:
    strategy = current[0].strategy
    return {
        "round": strategy.round,
        "agreed_by": len(current),
        "communication_time_s": strategy.communication_s,
        "potential_s": strategy.potential_s,
        "initial_potential_s": strategy.initial_potential_s,
        "iterations": strategy.iteration,
    }


def _radio(picture: Picture, now_ns: int) -> _Status:
    """Return who hears whom; to be apart between meetings is as it should be."""
    connectivity = picture.connectivity
    if connectivity is None or now_ns - connectivity.stamp_ns > _SILENT_NS:
        return _status("radio", Level.STALE, "no word of who hears whom", {})
    linked = {end for edge in connectivity.edges for end in edge}
    values = {
        "links": len(connectivity.edges),
        "alone": len(picture.agents) - len(linked),
        "connected": connectivity.connected,
        "connected_for_s": seconds(picture.windows.connected_ns(now_ns)),
    }
    if connectivity.connected:
        return _status("radio", Level.OK, "all connected", values)
    if all(agent.is_there for agent in picture.agents.values()):
        return _status("radio", Level.ERROR, "all at their places, but not connected", values)
    return _status("radio", Level.OK, "apart", values)


def _window(picture: Picture, now_ns: int) -> _Status:
    """Return how much time there is until the meeting of this window can begin no more."""
    windows = picture.windows
    number = now_ns // windows.period_ns
    closes_ns = (number + 1) * windows.period_ns
    begins_ns = max(now_ns, _meeting_ns(picture, number) or now_ns)
    slack_ns = closes_ns - begins_ns
    is_kept = windows.is_kept(number)
    values = {
        "window": number,
        "closes_s": seconds(closes_ns),
        "kept": is_kept,
        "missed": windows.missed,
        "slack_s": seconds(slack_ns),
    }
    if windows.missed:
        return _status("window", Level.ERROR, f"windows missed: {windows.missed}", values)
    if is_kept:
        return _status("window", Level.OK, f"window {number} is kept", values)
    level = Level.WARN if slack_ns < _LITTLE * windows.period_ns else Level.OK
    text = f"window {number}: {seconds(slack_ns):.1f} s to spare"
    return _status("window", level, text, values)


def _meeting_ns(picture: Picture, number: int) -> int | None:
    """Return when the meeting in a window begins, if one is agreed."""
    times_s = [
        agent.held.strategy.communication_s
        for agent in picture.agents.values()
        if agent.held is not None and agent.held.strategy.round == number
    ]
    return nanoseconds(max(times_s)) if times_s and picture.method.meets_in_windows else None


def _agents(picture: Picture, now_ns: int) -> Iterator[_Status]:
    for name, agent in picture.agents.items():
        if agent.odometry is None or now_ns - agent.odometry.stamp_ns > _SILENT_NS:
            yield _status(name, Level.STALE, "no word of where it is", {}, name)
            continue
        fault = _recent_fault(agent, now_ns)
        level = Level.OK if fault is None else Level.WARN
        message = _activity(agent) if fault is None else fault.event.detail
        yield _status(name, level, message, _agent_values(agent), name)


def _agent_values(agent: AgentPicture) -> dict[str, object]:
    assert agent.odometry is not None
    return {
        "x_m": agent.odometry.pose.x_m,
        "y_m": agent.odometry.pose.y_m,
        "speed_mps": agent.odometry.linear_mps,
        "plan_index": agent.done_index,
        "tasks_satisfied": agent.satisfied,
    }


def _activity(agent: AgentPicture) -> str:
    """Return the last that an agent did, in words."""
    if agent.event is None:
        return "waiting"
    event = agent.event.event
    words = event.kind.name.lower().replace("_", " ")
    where = f" at {event.region}" if event.region else ""
    return f"{words}{where}: {event.action}" if event.action else f"{words}{where}"
