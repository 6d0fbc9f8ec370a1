"""Spinning a node, by executor and by wait set."""

import os
import signal
import subprocess
import sys
import threading
from typing import Any

import pytest
from rclpy.callback_groups import ReentrantCallbackGroup
from rclpy.clock import Clock, ROSClock
from rclpy.clock_type import ClockType
from rclpy.context import Context
from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.time import Time
from std_msgs.msg import UInt64

from tlcomm_msgs.srv import ChangeTask
from tlcomm_tools.runtime import spin as module
from tlcomm_tools.runtime.spin import Spin, spin, spin_executor, spin_fast

SPINS = [spin, spin_fast, spin_executor]
STEADY = Clock(clock_type=ClockType.STEADY_TIME)


def node_of(context: Context, name: str = "node") -> Node:
    """Return a node without services."""
    return Node(
        name,
        context=context,
        use_global_arguments=False,
        enable_rosout=False,
        start_parameter_services=False,
        parameter_overrides=[Parameter("start_type_description_service", value=False)],
    )


class Refusing(ReentrantCallbackGroup):
    """A callback group that refuses until told otherwise."""

    refuses = True

    def can_execute(self, entity: object) -> bool:
        """Execute nothing while it refuses."""
        return not self.refuses and super().can_execute(entity)


@pytest.mark.parametrize("way", SPINS)
def test_messages_and_timers(context: Context, way: Spin) -> None:
    """Every message arrives, in order; timers run, and entities made while spinning too."""
    node = node_of(context)
    publisher = node.create_publisher(UInt64, "number", 1000)
    heard: list[int] = []
    late: list[int] = []

    def begin() -> None:
        if not publisher.get_subscription_count():
            return
        timer.cancel()
        node.create_timer(0.001, lambda: late.append(1), clock=STEADY)
        for number in range(500):
            publisher.publish(UInt64(data=number))

    node.create_subscription(UInt64, "number", lambda message: heard.append(message.data), 1000)
    timer = node.create_timer(0.01, begin, clock=STEADY)
    way(node, lambda: len(heard) == 500 and len(late) > 2)
    assert heard == list(range(500))


@pytest.mark.parametrize("way", SPINS)
def test_raw_messages(context: Context, way: Spin) -> None:
    """A raw subscription gets bytes."""
    node = node_of(context)
    publisher = node.create_publisher(UInt64, "number", 10)
    heard: list[bytes] = []
    node.create_subscription(UInt64, "number", heard.append, 10, raw=True)
    node.create_timer(0.01, lambda: publisher.publish(UInt64(data=7)), clock=STEADY)
    way(node, lambda: bool(heard))
    assert heard[0].endswith((7).to_bytes(8, "little"))


@pytest.mark.parametrize("way", SPINS)
def test_a_guard_condition_runs_when_triggered(context: Context, way: Spin) -> None:
    """A callback may ask for another one; it runs after it, and not by itself."""
    node = node_of(context)
    calls: list[str] = []

    def ask() -> None:
        calls.append("asked")
        guard.trigger()

    guard = node.create_guard_condition(lambda: calls.append("ran"))
    node.create_timer(0.01, ask, clock=STEADY)
    way(node, lambda: calls.count("ran") == 3)
    assert calls == 3 * ["asked", "ran"]


@pytest.mark.parametrize("way", SPINS)
def test_what_may_not_be_executed_waits(context: Context, way: Spin) -> None:
    """Messages of a callback group that refuses stay where they are until it doesn't."""
    node = node_of(context)
    heard: list[int] = []
    waited: list[int] = []
    group = Refusing()
    publisher = node.create_publisher(UInt64, "number", 10)
    node.create_subscription(
        UInt64, "number", lambda message: heard.append(message.data), 10, callback_group=group
    )

    def pass_time() -> None:
        if not publisher.get_subscription_count():
            return
        if not waited:
            for number in range(5):
                publisher.publish(UInt64(data=number))
        waited.append(len(heard))
        group.refuses = len(waited) < 5

    node.create_timer(0.01, pass_time, clock=STEADY)
    way(node, lambda: len(heard) == 5)
    assert heard == list(range(5))
    assert waited[:5] == [0] * 5


class Patient(Node):
    """A node that wakes up for one subscription, and takes another's messages along."""

    def __init__(self, context: Context) -> None:
        super().__init__(
            "patient",
            context=context,
            use_global_arguments=False,
            enable_rosout=False,
            start_parameter_services=False,
            parameter_overrides=[Parameter("start_type_description_service", value=False)],
        )
        self.heard: list[str] = []
        self.urgent: object = self._listen("tick")
        self._listen("number")

    def _listen(self, topic: str) -> object:
        return self.create_subscription(
            UInt64, topic, lambda message: self.heard.append(f"{topic} {message.data}"), 10
        )


@pytest.mark.parametrize("is_patient", [True, False])
def test_what_came_before_an_urgent_message_is_taken_first(
    context: Context, is_patient: bool
) -> None:
    """Though its subscription is the first; a node without an urgent one takes them as they are."""
    node = Patient(context)
    if not is_patient:
        node.urgent = None
    publishers = [node.create_publisher(UInt64, topic, 10) for topic in ("number", "tick")]

    def begin() -> None:
        if all(publisher.get_subscription_count() for publisher in publishers):
            timer.cancel()
            for publisher in publishers:
                publisher.publish(UInt64(data=1))
                publisher.publish(UInt64(data=2))

    timer = node.create_timer(0.01, begin, clock=STEADY)
    spin_fast(node, lambda: len(node.heard) == 4)
    if is_patient:
        assert node.heard == ["number 1", "number 2", "tick 1", "tick 2"]
    assert sorted(node.heard) == ["number 1", "number 2", "tick 1", "tick 2"]


@pytest.mark.parametrize("way", SPINS)
def test_services_answer(context: Context, way: Spin) -> None:
    """Each request gets its own response, also of several that come together."""
    node, asker = node_of(context), node_of(context, "asker")
    answers: list[Any] = []

    def answer(request: ChangeTask.Request, response: ChangeTask.Response) -> ChangeTask.Response:
        response.message = f"not {request.task}"
        return response

    def ask() -> None:
        client = asker.create_client(ChangeTask, "change_task")
        executor = SingleThreadedExecutor(context=context)
        executor.add_node(asker)
        assert client.wait_for_service(10.0)
        calls = [client.call_async(ChangeTask.Request(task=task)) for task in "abc"]
        for call in calls:
            executor.spin_until_future_complete(call, 10.0)
            answers.append(call.result().message)
        executor.shutdown()

    node.create_service(ChangeTask, "change_task", answer)
    thread = threading.Thread(target=ask)
    thread.start()
    way(node, lambda: not thread.is_alive())
    assert answers == ["not a", "not b", "not c"]


@pytest.mark.parametrize("way", SPINS)
def test_errors_of_callbacks_come_through(context: Context, way: Spin) -> None:
    """What a callback raises ends the spin."""
    node = node_of(context)

    def fail() -> None:
        raise ZeroDivisionError

    node.create_timer(0.01, fail, clock=STEADY)
    with pytest.raises(ZeroDivisionError):
        way(node, lambda: False)


@pytest.mark.parametrize("way", SPINS)
def test_shutdown_ends_it(context: Context, way: Spin) -> None:
    """A context that is shut down ends the spin with the same exception."""
    node = node_of(context)
    node.create_timer(0.01, context.try_shutdown, clock=STEADY)
    with pytest.raises(ExternalShutdownException):
        way(node, lambda: False)


@pytest.mark.parametrize("way", SPINS)
def test_failure_amid_a_shutdown_is_the_shutdown(context: Context, way: Spin) -> None:
    """What rclpy raises because its context has gone meanwhile is no error of anybody's."""
    node = node_of(context)

    def fail_late() -> None:
        context.try_shutdown()
        raise RuntimeError("the publisher's context is invalid")

    node.create_timer(0.01, fail_late, clock=STEADY)
    with pytest.raises(ExternalShutdownException):
        way(node, lambda: False)


@pytest.mark.parametrize("way", SPINS)
def test_timers_keep_simulated_time(context: Context, way: Spin) -> None:
    """A timer on a simulated clock runs once when its time has come, and not again by itself."""
    node = node_of(context)
    clock = ROSClock()
    clock._set_ros_time_is_active(True)
    clock.set_ros_time_override(Time(seconds=1, clock_type=ClockType.ROS_TIME))
    wall: list[int] = []
    simulated: list[int] = []

    def pass_time() -> None:
        wall.append(len(simulated))
        if len(wall) == 10:
            clock.set_ros_time_override(Time(seconds=12, clock_type=ClockType.ROS_TIME))

    node.create_timer(10.0, lambda: simulated.append(len(wall)), clock=clock)
    node.create_timer(0.01, pass_time, clock=STEADY)
    way(node, lambda: len(wall) == 20)
    assert len(simulated) == 1
    assert simulated[0] >= 10


def test_way_is_chosen(context: Context, monkeypatch: pytest.MonkeyPatch) -> None:
    """The wait set serves nodes without clients, as long as rclpy has one."""
    node = node_of(context)
    assert module._can_spin_fast(node)
    assert module._can_spin_fast(Node("full", context=context, use_global_arguments=False))
    node.create_client(ChangeTask, "change_task")
    assert not module._can_spin_fast(node)
    monkeypatch.delattr(module.rclpy_implementation, "WaitSet")
    assert not module._can_spin_fast(node_of(context, "other"))


PROGRAM = """
import signal
import sys
import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node
from rclpy.parameter import Parameter
from rclpy.time import Time
from tlcomm_tools.runtime import spin
signal.signal(signal.SIGINT, lambda *_: None)
rclpy.init(args=[])
node = Node("node", start_parameter_services=False,
            parameter_overrides=[Parameter("start_type_description_service", value=False)])
try:
    timer = node.create_timer(0.01, lambda: (timer.cancel(), print("ready", flush=True)))
    getattr(spin, sys.argv[1])(node, lambda: False)
except ExternalShutdownException:
    rclpy.try_shutdown()
    sys.exit(42)
"""


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("way", ["spin_fast", "spin_executor"])
def test_signals_end_it(domain: int, way: str, number: signal.Signals) -> None:
    """A signal ends a process that spins in good order, though nothing else happens in it."""
    environment = {**os.environ, "ROS_DOMAIN_ID": str(domain)}
    environment["PYTHONPATH"] = os.pathsep.join(path for path in sys.path if path)
    with subprocess.Popen(
        [sys.executable, "-c", PROGRAM, way],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        env=environment,
        text=True,
    ) as process:
        assert process.stdout is not None
        assert process.stdout.readline() == "ready\n"
        process.send_signal(number)
        _, errors = process.communicate(timeout=20.0)
    assert (process.returncode, errors) == (42, "")
