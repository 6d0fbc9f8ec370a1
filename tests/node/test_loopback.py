"""The middleware's profile for a run on one machine."""

import os
import signal
import subprocess
import sys

from rclpy.context import Context
from rclpy.node import Node

from tlcomm_msgs import msg

COUNT = 1000
# Together with a thousand of these a stopped process's socket overflows, its 4 MB or fewer.
NAME = "x" * 20_000
# Fast DDS's own heartbeat comes every 3 s, and ours repairs within a tenth of a second.
LATEST_S = 2.5
HEARER = f"""
import os, rclpy
from tlcomm_msgs.msg import Confirmation
rclpy.init()
node, heard = rclpy.create_node("hearer"), []
subscription = node.create_subscription(Confirmation, "word", heard.append, {COUNT})
while not subscription.get_publisher_count():
    pass
print("found", flush=True)
while len(heard) < {COUNT}:
    rclpy.spin_once(node)
os._exit(0)
"""


def test_what_a_burst_lost_is_repaired_at_once(context: Context, domain: int) -> None:
    """A hearer whose socket has overflowed has everything long before the default heartbeat."""
    environment = {**os.environ, "ROS_DOMAIN_ID": str(domain)}
    node = Node("speaker", context=context, use_global_arguments=False)
    publisher = node.create_publisher(msg.Confirmation, "word", COUNT)
    with subprocess.Popen(
        [sys.executable, "-c", HEARER],
        env=environment,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    ) as hearer:
        assert hearer.stdout is not None
        try:
            assert hearer.stdout.readline() == "found\n"
            while not publisher.get_subscription_count():
                assert hearer.poll() is None
            hearer.send_signal(signal.SIGSTOP)
            for number in range(COUNT):
                publisher.publish(msg.Confirmation(sender=NAME, iteration=number))
            hearer.send_signal(signal.SIGCONT)
            _, errors = hearer.communicate(timeout=LATEST_S)
        finally:
            hearer.kill()
    node.destroy_node()
    assert (hearer.returncode, errors) == (0, "")
