"""One agent as a ROS 2 node: a thin shell around its brain and radio.

``main``       ``ros2 run tlcomm_agent agent --ros-args -r __ns:=/agent_1 -p scenario:=…``
``AgentNode``  the node
"""

import sys
import time
from collections import Counter
from collections.abc import Callable, Container, Sequence
from typing import Any, Final

import rclpy
from nav_msgs.msg import OccupancyGrid, Odometry
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rclpy.serialization import deserialize_message

from tlcomm_agent import tasking, wire, wire_map, wire_messages
from tlcomm_agent.arrivals import Arrivals
from tlcomm_agent.config import PARAMETERS, AgentConfig
from tlcomm_agent.hearing import Hearings
from tlcomm_agent.ignored import Ignored
from tlcomm_core.agent import actions
from tlcomm_core.agent.controller import CONTROL_PERIOD_S, Pacing
from tlcomm_core.agent.member import create
from tlcomm_core.agent.timing import TimedMember
from tlcomm_core.errors import InputError, PlanningError, TlcommError
from tlcomm_core.scenario.site import Site
from tlcomm_core.units import nanoseconds
from tlcomm_core.wire.fields import WireError
from tlcomm_core.wire.team_messages import decode_message
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_msgs import msg, srv

__all__ = ["AgentNode", "main"]

_DEPTH: Final = 1000
_COUNTED: Final = QoSProfile(depth=_DEPTH, reliability=ReliabilityPolicy.RELIABLE)
# The protocol repeats what is lost, and needs no more than the last few of anybody's messages.
_BY_RADIO: Final = QoSProfile(depth=10, reliability=ReliabilityPolicy.BEST_EFFORT)
_HELD_STRATEGIES: Final = 10
_HELD: Final = QoSProfile(depth=_HELD_STRATEGIES, durability=DurabilityPolicy.TRANSIENT_LOCAL)
_READY_PERIOD_S: Final = 0.1
_LEAVE_PERIOD_S: Final = 0.05
_STATUS_INPUT: Final = 2
_STATUS_BROKEN: Final = 3


class _Attention(ReentrantCallbackGroup):
    """Another agent's messages, taken while there is a point in it."""

    def __init__(self, other: str, attended: Callable[[], Container[str]]) -> None:
        super().__init__()
        self._other = other
        self._attended = attended

    def can_execute(self, entity: object) -> bool:  # noqa: ARG002 (the group stands for it)
        """Tell whether the other's messages are to be taken now."""
        return self._other in self._attended()


class AgentNode(Node):
    """An agent's brain and radio on topics.

    In lock step it acts when ticked, once everything that the tick counts has arrived.

    Running freely, it acts once for all that came together, and at 20 Hz of the node's clock. Most
    of what a short message costs is waking up for it; so of whom isn't in range nothing is taken,
    and while the protocol can't go on without one agent's word, nobody else's: what others say
    meanwhile waits, and is taken together. What overflows is lost, as it may be by radio.

    Attributes:
        config: who it is.
        is_done: it has been told that the run is over, and the sim has gone.
        ignored: per reason, how many messages changed nothing.
    """

    def __init__(
        self,
        *,
        namespace: str | None = None,
        parameters: Sequence[Parameter] = (),
        context: Context | None = None,
        on_ready: Callable[[], None] = lambda: None,
    ) -> None:
        """Read the parameters (``config.PARAMETERS``); plan.

        Args:
            namespace: the agent's name, unless the command line says it.
            parameters: overrides.
            context: the default one, or a test's own.
            on_ready: called when the node has found all the others.

        Raises:
            InputError: a parameter or the scenario can't be used.
            PlanningError: the agent's task has no plan.
        """
        no_service = Parameter("start_type_description_service", value=False)
        super().__init__(
            "agent",
            namespace=namespace,
            context=context,
            enable_rosout=False,
            start_parameter_services=False,
            parameter_overrides=[no_service, *parameters],
        )
        self.config: Final = AgentConfig.from_parameters(self.get_namespace(), self._declared)
        self.is_done = False
        self.ignored: Final = Ignored()
        self._on_ready: Final = on_ready
        self._is_lockstep: Final = self.config.pace.is_lockstep
        pacing = Pacing.EVENT if self._is_lockstep else Pacing.PERIODIC
        site = Site.from_scenario(self.config.scenario)
        atlas = Atlas(site.grid, site.region_discs)
        config = self.config
        self._member: Final = create(
            config.name, site, pacing, atlas, config.seed, config.solver, config.method
        )
        self._timed: Final = TimedMember(self._member, time.thread_time, time.time)
        self._taken: Final[Counter[str]] = Counter()
        latency_ns = nanoseconds(config.scenario.communication.hop_latency_s)
        self._arrivals: Final = Arrivals(config.others, latency_ns)
        self._hearings: Final = Hearings(config.name)
        self._tick: msg.Tick | None = None
        self._published: Final[Counter[str]] = Counter()
        self._is_ready = False
        self._is_stopped = False
        self._neighbours: Container[str] = ()
        self._attended: Container[str] = self.config.others if self._is_lockstep else ()
        self._grid: Final = site.grid
        self._team_types: Final = wire_messages.team_types(measures=config.measures)
        self._create_publishers()
        self._create_listeners()
        self._create_occasions()

    def _declared(self, name: str) -> object:
        descriptor = ParameterDescriptor(dynamic_typing=True)
        return self.declare_parameter(name, PARAMETERS[name], descriptor).value

    def _create_publishers(self) -> None:
        self._answer_pub = self.create_publisher(msg.TickReply, "/tick_reply", _DEPTH)
        self._pubs = {
            topic: self.create_publisher(kind, topic, _HELD if topic == "team_strategy" else _DEPTH)
            for topic, kind in {**wire.TYPES, **self._team_types}.items()
        }

    def _create_listeners(self) -> None:
        subscribe = self.create_subscription
        self._tick_sub = subscribe(msg.Tick, "tick", self._take_tick, _DEPTH)
        own = [
            subscribe(kind, topic, self._taking(topic.removeprefix("/"), see), quality)
            for kind, topic, see, quality in (
                (Odometry, "odom", self._see_odometry, _DEPTH),
                (msg.Connectivity, "/connectivity", self._see_connectivity, _DEPTH),
                (OccupancyGrid, "/map", self._see_map, _HELD),
                (msg.Reading, "reading", self._see_reading, _DEPTH),
            )
            if kind is not msg.Reading or self.config.measures
        ]
        team = [
            self._subscribe_team(other, topic, kind)
            for other in self.config.others
            for topic, kind in self._team_types.items()
        ]
        self._own_subscriptions = (*own, self._tick_sub, *team)
        self.create_service(srv.ChangeTask, "change_task", self._change_task)

    def _create_occasions(self) -> None:
        self._steady = Clock(clock_type=ClockType.STEADY_TIME)
        self._ready_timer = self.create_timer(_READY_PERIOD_S, self._say_ready, clock=self._steady)
        if not self._is_lockstep:
            self._news = self.create_guard_condition(self._step_freely)
            self.create_timer(CONTROL_PERIOD_S, self._step_freely)

    @property
    def urgent(self) -> object:
        """What alone need wake the agent up now: in lock step the tick, unless that is there."""
        return self._tick_sub if self._is_lockstep and self._tick is None else None

    def _subscribe_team(self, other: str, topic: str, kind: type) -> Any:  # noqa: ANN401 (opaque)
        def take(data: bytes) -> None:
            sent_ns = self._hear(other, topic, data)
            if self._is_lockstep:
                self._arrivals.note(other, sent_ns)
            self._proceed()

        return self.create_subscription(
            kind,
            f"/{other}/{topic}",
            take,
            _COUNTED if self._is_lockstep else _BY_RADIO,
            callback_group=_Attention(other, lambda: self._attended),
            raw=True,
        )

    def _taking(self, topic: str, see: Callable[[Any], None]) -> Callable[[Any], None]:
        def take(message: object) -> None:
            self._taken[topic] += 1
            try:
                see(message)
            except WireError as error:
                self._ignore(f"{topic}: {error}")
            self._proceed()

        return take

    def _see_odometry(self, message: Odometry) -> None:
        seen = wire.decode_odometry(message, self.config.name)
        self._member.see_odometry(seen.stamp_ns, seen.pose, seen.linear_mps, seen.angular_radps)

    def _see_connectivity(self, message: msg.Connectivity) -> None:
        distances_m, stamp_ns = wire.decode_neighbours(message, self.config.name)
        self._neighbours = distances_m.keys()
        self._member.see_neighbours(stamp_ns, distances_m)
        self._attend()

    def _see_map(self, message: OccupancyGrid) -> None:
        self._member.see_map(*wire_map.decode_map(message, self._grid))

    def _see_reading(self, message: msg.Reading) -> None:
        self._member.see_reading(*wire.decode_reading(message, self.config.name))

    def _change_task(self, request: Any, response: Any) -> Any:  # noqa: ANN401 (rclpy's are opaque)
        """Stand still while the plan for another task is made, which may take a second."""
        answer = tasking.IN_LOCKSTEP
        if not self._is_lockstep:
            now_ns = self._now_ns()
            self._perform(actions.Drive(0.0, 0.0), now_ns)
            answer = tasking.change_task(self._member, request.task, now_ns)
        response.accepted, response.message = answer
        return response

    def _attend(self) -> None:
        """Choose whose messages are to be taken; in lock step all are."""
        if not self._is_lockstep:
            awaited = self._member.awaited
            self._attended = self._neighbours if awaited is None else (awaited,)

    def _hear(self, other: str, topic: str, data: bytes) -> int:
        """Take what another agent's topic carries, whatever that is; return when it was sent.

        What can't be read counts as sent at the start, so that nobody waits for it.
        """
        kind = self._team_types[topic]
        try:
            message, sent_ns = decode_message(deserialize_message(data, kind), topic)
        except WireError as error:
            self._ignore(f"{other}: {error}")
            return 0
        except RuntimeError as error:  # rclpy's RMWError, which has no public name
            self._ignore(f"{other}: not a {kind.__name__}: {error}")
            return 0
        if message.sender != other:
            self._ignore(f"{other}: a message in the name of {message.sender!r}")
            return sent_ns
        # Running freely, the sender's clock may be a tick ahead of this one's.
        self._member.receive(message, sent_ns, None if self._is_lockstep else self._now_ns())
        return sent_ns

    def _take_tick(self, tick: msg.Tick) -> None:
        self._ready_timer.cancel()
        if len(tick.agent_counts) != len(self.config.scenario.agents):
            self._ignore(f"tick: {len(tick.agent_counts)} counts")
        elif self._is_lockstep:
            self._tick = tick
            self._proceed()
        elif tick.stop:
            self._stop(tick)

    def _proceed(self) -> None:
        """Act, if it is time to; free running, once for all that came together."""
        if not self._is_lockstep:
            self._news.trigger()
        elif (tick := self._tick) is not None and self._has_all(tick):
            self._tick = None
            if tick.stop:
                self._stop(tick)
            else:
                self._step(tick.time_ns)
                self._answer(tick.sequence)

    def _stop(self, tick: msg.Tick) -> None:
        """Act no more; stay until the sim has gone, to send again what somebody has missed."""
        self._is_stopped = True
        self._publish_undelivered(tick.time_ns)
        self._publish("hearing", wire.encode_hearing(self._hearings.take(), tick.time_ns))
        self._answer(tick.sequence)
        self.create_timer(_LEAVE_PERIOD_S, self._leave_after_sim, clock=self._steady)

    def _leave_after_sim(self) -> None:
        self.is_done = self._tick_sub.get_publisher_count() == 0

    def _has_all(self, tick: msg.Tick) -> bool:
        due = dict(zip(self.config.scenario.agents, tick.agent_counts, strict=True))
        return (
            self._taken["odom"] >= tick.odometry_count
            and self._taken["connectivity"] >= tick.connectivity_count
            and self._taken["map"] >= tick.map_count
            and self._taken["reading"] >= tick.reading_count
            and self._arrivals.are_complete(due, tick.time_ns)
        )

    def _step_freely(self) -> None:
        if not self._taken["odom"] or self._is_stopped:
            return
        self._ready_timer.cancel()
        has_met = self._step(self._now_ns())
        self._attend()
        if has_met or self._member.measured_at:
            self._answer(0)

    def _step(self, now_ns: int) -> bool:
        """Act; return whether a meeting has ended."""
        meetings_ended = self._member.meetings_ended
        due, timing = self._timed.step(now_ns)
        for action in due:
            self._perform(action, now_ns)
        if timing is not None:
            self._publish("round_timing", wire.encode_round_timing(timing, now_ns))
        if self._hearings.note(self._member.heard, now_ns):
            self._publish("hearing", wire.encode_hearing(self._hearings.take(), now_ns))
        has_met = self._member.meetings_ended != meetings_ended
        if has_met:
            self._publish_undelivered(now_ns)
        return has_met

    def _publish_undelivered(self, now_ns: int) -> None:
        counts = self._member.undelivered
        self._publish("undelivered", wire.encode_undelivered(counts, self.config.name, now_ns))

    def _perform(self, action: actions.Action, now_ns: int) -> None:
        if isinstance(action, actions.CountIgnored):
            self.ignored[action.reason] += 1
        else:
            self._publish(*wire.encode_action(action, self.config.name, now_ns))

    def _publish(self, topic: str, message: object) -> None:
        self._published[topic] += 1
        self._pubs[topic].publish(message)

    def _answer(self, sequence: int) -> None:
        answer = wire.encode_answer(self._member, sequence, self._published, self._team_types)
        answer.ready = self._is_ready
        self._answer_pub.publish(answer)

    def _say_ready(self) -> None:
        """Tell the sim, again and again until it begins, whether everybody has been found."""
        if not self._is_ready and self._is_matched():
            self._is_ready = True
            self._on_ready()
        self._answer(0)

    def _is_matched(self) -> bool:
        """Whether every topic has found those whom it needs."""
        others, recorders = len(self.config.others), int(self.config.has_recorder)
        hearers = {"cmd_vel": 1, **dict.fromkeys(self._team_types, others)}
        publishers = [(self._answer_pub, 1)]
        publishers += [(self._pubs[t], hearers.get(t, 0) + recorders) for t in self._pubs]
        return all(p.get_subscription_count() >= least for p, least in publishers) and all(
            subscription.get_publisher_count() for subscription in self._own_subscriptions
        )

    def _now_ns(self) -> int:
        return int(self.get_clock().now().nanoseconds)

    def log_end(self) -> None:
        """Log what was ignored."""
        self.get_logger().info(f"done; ignored: {dict(self.ignored)}")

    def _ignore(self, reason: str) -> None:
        if (news := self.ignored.note(reason)) is not None:
            self.get_logger().warning(f"ignored: {news}")


def main(args: Sequence[str] | None = None) -> int:
    """Run an agent until the run is over or a signal comes; return the exit status."""
    try:
        rclpy.init(args=args)
        node = AgentNode()
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        while not node.is_done:
            executor.spin_once()
        node.log_end()
    except (KeyboardInterrupt, ExternalShutdownException):
        return 0
    except TlcommError as error:
        print(f"agent: {error}", file=sys.stderr)  # noqa: T201 (the one line to the user)
        return _STATUS_INPUT if isinstance(error, InputError | PlanningError) else _STATUS_BROKEN
    finally:
        rclpy.try_shutdown()
    return 0
