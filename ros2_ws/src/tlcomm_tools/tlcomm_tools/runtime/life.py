"""A node's life in a supervised process.

``live``  from the node's making until the run is over or a signal comes
"""

import signal
from collections.abc import Callable

import rclpy
from rclpy.executors import ExternalShutdownException
from rclpy.node import Node

from tlcomm_tools.runtime.notify import Finished, Notifier, Started
from tlcomm_tools.runtime.spin import spin

__all__ = ["live"]


def live(make: Callable[[], Node], notifier: Notifier) -> int:
    """Make a node and execute it until it is done or a signal comes; return the exit status.

    Args:
        make: makes the node in the default context; it has ``is_done`` and ``log_end()``.
        notifier: is told when the node exists and, unless a signal came, when it is done.
    """
    # rclpy shuts itself down on SIGINT; a KeyboardInterrupt besides could strike anywhere.
    previous = signal.signal(signal.SIGINT, lambda *_: None)
    rclpy.init(args=[])
    try:
        node = make()
        notifier.tell(Started())
        spin(node, lambda: node.is_done)
        node.log_end()
    except ExternalShutdownException:
        return 0
    except RuntimeError:
        # A signal that shuts rclpy down in the midst of anything makes it fail in its own ways.
        if rclpy.ok():
            raise
        return 0
    finally:
        rclpy.try_shutdown()
        signal.signal(signal.SIGINT, previous)
    notifier.tell(Finished())
    return 0
