"""The sim as a ROS 2 node: a thin shell around the world and its conductor.

``main``            the executable: ``ros2 run tlcomm_sim sim --ros-args -p scenario:=…``
``SimNode``         the node
``RunBrokenError``  somebody doesn't answer
"""

import sys
import time
from collections.abc import Callable, Sequence
from typing import Any, Final, assert_never

import rclpy
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import OccupancyGrid
from nav_msgs.msg import Odometry as OdometryMessage
from rcl_interfaces.msg import ParameterDescriptor
from rclpy.clock import Clock
from rclpy.clock_type import ClockType
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy
from rosgraph_msgs.msg import Clock as ClockMessage

from tlcomm_core.errors import InputError, TlcommError
from tlcomm_core.units import nanoseconds, seconds
from tlcomm_core.wire.world_messages import decode_command
from tlcomm_core.world.observation import Connectivity, Observation, Occupancy, Odometry, Reading
from tlcomm_msgs import msg
from tlcomm_sim import wire
from tlcomm_sim.conductor import RECORDER
from tlcomm_sim.config import SimConfig
from tlcomm_sim.outputs import (
    Leave,
    Output,
    Show,
    ShowClock,
    TickAgent,
    TickRecorder,
    Warn,
)

__all__ = ["RunBrokenError", "SimNode", "main"]

_DEPTH: Final = 1000
# More than a scenario has: whoever comes late gets them all.
_MAPS: Final = 200
_READY_PERIOD_S: Final = 0.1
_LONGEST_PERIOD_S: Final = 0.02
_SHORTEST_PERIOD_S: Final = 0.002
_REPORT_PERIOD_S: Final = 0.2
_ANSWER_DEADLINE_S: Final = 10.0
_STATUS_INPUT: Final = 2
_STATUS_BROKEN: Final = 3


class RunBrokenError(TlcommError):
    """The run can't go on; the text names whoever is to blame."""


class SimNode(Node):
    """World, clock and conductor on topics.

    Attributes:
        config: what it runs.
        is_done: the run is over, and everybody has been told.
    """

    def __init__(
        self,
        *,
        parameters: Sequence[Parameter] = (),
        context: Context | None = None,
        on_ready: Callable[[], None] = lambda: None,
        on_progress: Callable[[int, int], None] = lambda _ns, _meetings: None,
    ) -> None:
        """Read the parameters.

        They are ``scenario``, ``pace``, ``seed``, ``rounds``, ``until_s`` and ``recorder``.

        Args:
            parameters: overrides.
            context: the default one, or a test's own.
            on_ready: called when everybody is ready and the run begins.
            on_progress: called now and then with the simulated time (ns) and the meetings ended.

        Raises:
            InputError: a parameter or the scenario can't be used.
        """
        super().__init__(
            "sim",
            context=context,
            enable_rosout=False,
            start_parameter_services=False,
            parameter_overrides=[
                Parameter("start_type_description_service", value=False),
                *parameters,
            ],
        )
        self.config: Final = SimConfig.from_parameters(self._declared)
        self.is_done = False
        self._on_ready: Final = on_ready
        self._on_progress: Final = on_progress
        self._agents: Final = tuple(self.config.mission.site.scenario.agents)
        self._measuring: Final = self._agents if self.config.measures else ()
        self._world: Final = self.config.create_world()
        self._conductor: Final = self.config.create_conductor(self._world)
        self._ready: set[str] = set()
        self._reported_ns = -1
        self._watched: tuple[object, ...] = ()
        self._watched_since_ns = 0
        self._create_publishers()
        self._create_subscriptions()
        self._steady: Final = Clock(clock_type=ClockType.STEADY_TIME)
        self._ready_timer: Final = self.create_timer(
            _READY_PERIOD_S, self._begin_when_ready, clock=self._steady
        )

    def _declared(self, name: str) -> object:
        defaults = {"scenario": "", "pace": "lockstep", "seed": 0, "recorder": False}
        descriptor = ParameterDescriptor(dynamic_typing=True)
        return self.declare_parameter(name, defaults.get(name), descriptor).value

    def _create_publishers(self) -> None:
        create = self.create_publisher
        self._clock_pub = create(ClockMessage, "/clock", _DEPTH)
        self._connectivity_pub = create(msg.Connectivity, "/connectivity", _DEPTH)
        held = QoSProfile(
            depth=_MAPS,
            reliability=ReliabilityPolicy.RELIABLE,
            durability=DurabilityPolicy.TRANSIENT_LOCAL,
        )
        self._map_pub = create(OccupancyGrid, "/map", held)
        self._odometry_pubs = {
            agent: create(OdometryMessage, f"/{agent}/odom", _DEPTH) for agent in self._agents
        }
        self._reading_pubs = {
            agent: create(msg.Reading, f"/{agent}/reading", _DEPTH) for agent in self._measuring
        }
        self._tick_pubs = {
            agent: create(msg.Tick, f"/{agent}/tick", _DEPTH) for agent in self._agents
        }
        self._recorder_pub = create(msg.Tick, f"/{RECORDER}/tick", _DEPTH)

    def _create_subscriptions(self) -> None:
        self._answers_sub = self.create_subscription(
            msg.TickReply, "/tick_reply", self._take_answer, _DEPTH
        )
        self._command_subs = [self._subscribe_commands(agent) for agent in self._agents]

    def _subscribe_commands(self, agent: str) -> Any:  # noqa: ANN401 (rclpy's are opaque)
        def take(message: TwistStamped) -> None:
            command = decode_command(message)
            self._perform(self._conductor.take_command(agent, *command, time.monotonic_ns()))

        return self.create_subscription(TwistStamped, f"/{agent}/cmd_vel", take, _DEPTH)

    def _take_answer(self, message: msg.TickReply) -> None:
        answer = wire.decode_answer(message)
        if answer.ready:
            self._ready.add(answer.name)
        if self._ready_timer.is_canceled():
            self._perform(self._conductor.take_answer(answer))

    def _begin_when_ready(self) -> None:
        expected = {*self._agents, RECORDER} if self.config.has_recorder else {*self._agents}
        if not (expected <= self._ready and self._is_matched()):
            return
        self._ready_timer.cancel()
        self._on_ready()
        self._watched_since_ns = time.monotonic_ns()
        factor = self.config.pace.factor or 1.0
        period_s = max(_SHORTEST_PERIOD_S, min(_LONGEST_PERIOD_S, _LONGEST_PERIOD_S / factor))
        self.create_timer(period_s, self._pass_time, clock=self._steady)
        self.create_timer(_REPORT_PERIOD_S, self._report, clock=self._steady)
        self._perform(self._conductor.begin(time.monotonic_ns()))

    def _is_matched(self) -> bool:
        """Whether every topic has found those whom it needs."""
        recorders = int(self.config.has_recorder)
        count = len(self._agents)
        publishers = [
            (self._clock_pub, recorders),
            (self._connectivity_pub, count + recorders),
            (self._map_pub, count + recorders),
            *((publisher, 1 + recorders) for publisher in self._odometry_pubs.values()),
            *((publisher, 1 + recorders) for publisher in self._reading_pubs.values()),
            *((publisher, 1) for publisher in self._tick_pubs.values()),
            (self._recorder_pub, recorders),
        ]
        subscriptions = [
            (self._answers_sub, count + recorders),
            *((subscription, 1) for subscription in self._command_subs),
        ]
        return all(p.get_subscription_count() >= least for p, least in publishers) and all(
            s.get_publisher_count() >= least for s, least in subscriptions
        )

    def _pass_time(self) -> None:
        self._perform(self._conductor.pass_time(time.monotonic_ns()))

    def _report(self) -> None:
        """Report progress; give up when somebody has been silent for too long."""
        conductor, now_ns = self._conductor, time.monotonic_ns()
        if conductor.time_ns != self._reported_ns:
            self._reported_ns = conductor.time_ns
            self._on_progress(conductor.time_ns, conductor.meetings_ended)
        watched = (conductor.awaited, conductor.sequence)
        if not conductor.awaited or watched != self._watched:
            self._watched, self._watched_since_ns = watched, now_ns
        elif now_ns - self._watched_since_ns > nanoseconds(_ANSWER_DEADLINE_S):
            names = ", ".join(conductor.awaited)
            raise RunBrokenError(
                f"no answer from {names} within {_ANSWER_DEADLINE_S:g} s "
                f"at {seconds(conductor.time_ns):.3f} s of simulated time"
            )

    def _perform(self, outputs: Sequence[Output]) -> None:
        for output in outputs:
            match output:
                case ShowClock(time_ns):
                    self._clock_pub.publish(wire.encode_clock(time_ns))
                case Show(observation):
                    self._show(observation)
                case TickAgent(agent, tick):
                    self._tick_pubs[agent].publish(wire.encode_tick(tick))
                case TickRecorder(tick):
                    self._recorder_pub.publish(wire.encode_tick(tick))
                case Warn(text):
                    self.get_logger().warning(text)
                case Leave():
                    self._on_progress(self._conductor.time_ns, self._conductor.meetings_ended)
                    self.is_done = True
                case _:
                    assert_never(output)

    def log_end(self) -> None:
        """Log how often each agent ran into something, or commanded what can't be done."""
        collisions, refused = dict(self._world.collisions), dict(self._world.refused)
        self.get_logger().info(f"done; collisions: {collisions}; refused commands: {refused}")

    def _show(self, observation: Observation) -> None:
        match observation:
            case Odometry(agent=agent):
                self._odometry_pubs[agent].publish(wire.encode_odometry(observation))
            case Connectivity():
                range_m = self.config.mission.site.scenario.communication.range_m
                message = wire.encode_connectivity(observation, range_m, self._agents)
                self._connectivity_pub.publish(message)
            case Occupancy():
                self._map_pub.publish(wire.encode_occupancy(observation))
            case Reading(agent=agent):
                self._reading_pubs[agent].publish(wire.encode_reading(observation))
            case _:
                assert_never(observation)


def main(args: Sequence[str] | None = None) -> int:
    """Run the sim until the run is over or a signal comes; return the exit status."""
    try:
        rclpy.init(args=args)
        node = SimNode()
        executor = SingleThreadedExecutor()
        executor.add_node(node)
        while not node.is_done:
            executor.spin_once()
        node.log_end()
    except (KeyboardInterrupt, ExternalShutdownException):
        return 0
    except TlcommError as error:
        print(f"sim: {error}", file=sys.stderr)  # noqa: T201 (the one line to the user)
        return _STATUS_INPUT if isinstance(error, InputError) else _STATUS_BROKEN
    finally:
        rclpy.try_shutdown()
    return 0
