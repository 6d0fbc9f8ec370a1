"""Another task for a running agent, by the real service."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from nav_msgs.msg import Odometry as OdometryMessage
from rclpy.context import Context
from rclpy.node import Node
from rclpy.parameter import Parameter

from support.hall import STARTS, hall
from support.spinning import SpunNodes
from tlcomm_agent.node import AgentNode
from tlcomm_core.geometry import Pose
from tlcomm_core.scenario.loader import dumps
from tlcomm_core.world.observation import Odometry
from tlcomm_msgs import msg, srv
from tlcomm_sim.wire import encode_odometry


class Asking(SpunNodes):
    """A team of one at its first meeting, and who asks it to do something else."""

    def __init__(self, context: Context, folder: Path, pace: str) -> None:
        """Create both, at simulated time 0."""
        scenario = folder / "hall.yaml"
        scenario.write_text(dumps(hall(1).scenario))
        chosen = {"scenario": str(scenario), "pace": pace, "use_sim_time": pace != "lockstep"}
        parameters = [Parameter(name, value=value) for name, value in chosen.items()]
        self.agent = AgentNode(namespace="one", parameters=parameters, context=context)
        self.node = Node("test", context=context, use_global_arguments=False)
        super().__init__(context, self.agent, self.node)
        self.odometry_pub = self.node.create_publisher(OdometryMessage, "/one/odom", 10)
        self.held: list[Any] = []
        self.node.create_subscription(msg.TeamStrategy, "/one/team_strategy", self.held.append, 10)
        self.client = self.node.create_client(srv.ChangeTask, "/one/change_task")
        self.until(self.client.service_is_ready)
        self.until(lambda: self.odometry_pub.get_subscription_count() > 0)

    def agree(self) -> None:
        """Show the agent where it is; alone, it agrees with itself."""
        start = Pose(*STARTS["one"]).as_transmitted()
        self.odometry_pub.publish(encode_odometry(Odometry(0, "one", start, 0.0, 0.0)))
        self.until(lambda: bool(self.held))

    def ask(self, task: str) -> tuple[bool, str]:
        """Give the agent another task; return its answer."""
        call = self.client.call_async(srv.ChangeTask.Request(task=task))
        self.until(call.done)
        answer = call.result()
        return answer.accepted, answer.message


@pytest.fixture
def asking(context: Context, tmp_path: Path, request: pytest.FixtureRequest) -> Iterator[Asking]:
    """Yield a team of one that runs freely, or as a parameter says."""
    own = Asking(context, tmp_path, getattr(request, "param", "1.0"))
    yield own
    own.close()


def test_a_task_with_a_plan_is_accepted(asking: Asking) -> None:
    """The answer says from when on and what it takes."""
    asking.agree()
    accepted, message = asking.ask("G F (b & pick)")
    assert accepted
    assert message.startswith("from the next meeting on: ")
    assert "\n" not in message


@pytest.mark.parametrize(
    ("task", "reason"),
    [
        ("", "task: "),
        ("G F (b & sing)", "unknown region or action 'sing'"),
        ("F b & G !b", "contradict"),
    ],
)
def test_a_task_without_a_plan_is_refused(asking: Asking, task: str, reason: str) -> None:
    """The answer says why in one line, and the agent lives on."""
    asking.agree()
    accepted, message = asking.ask(task)
    assert not accepted
    assert reason in message
    assert "\n" not in message
    assert asking.ask("G F b")[0]


def test_before_the_agreement_a_task_is_refused(asking: Asking) -> None:
    """Where it would begin isn't known."""
    accepted, message = asking.ask("G F b")
    assert not accepted
    assert "isn't agreed on yet" in message


@pytest.mark.parametrize("asking", ["lockstep"], indirect=True)
def test_in_lock_step_a_task_is_refused(asking: Asking) -> None:
    """What comes from outside at any time would make runs differ."""
    accepted, message = asking.ask("G F b")
    assert not accepted
    assert "lock step" in message
