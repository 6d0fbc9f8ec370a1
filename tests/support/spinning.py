"""Nodes spun together in a test's own thread.

``SpunNodes``  some nodes of one context
"""

from collections.abc import Callable

from rclpy.context import Context
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node

__all__ = ["SpunNodes"]


class SpunNodes:
    """Nodes of one context, spun whenever a test waits for something."""

    def __init__(self, context: Context, *nodes: Node) -> None:
        """Take the nodes over."""
        self.executor = SingleThreadedExecutor(context=context)
        self._nodes = nodes
        for node in nodes:
            self.executor.add_node(node)

    def until(self, done: Callable[[], bool]) -> None:
        """Spin the nodes until something holds, at most 10 s."""
        for _ in range(1000):
            if done():
                return
            self.executor.spin_once(timeout_sec=0.01)
        raise AssertionError("nothing happened")

    def settle(self) -> None:
        """Spin until everything that has been published so far has been handled."""
        for _ in range(50):
            self.executor.spin_once(timeout_sec=0.005)

    def close(self) -> None:
        """Take the nodes down."""
        self.executor.shutdown()
        for node in self._nodes:
            node.destroy_node()
