"""Spinning one node in one thread, fast.

``spin``           until done: by ``spin_fast`` where it can be, else by ``spin_executor``
``spin_fast``      one wait set, built once and refilled in place
``spin_executor``  rclpy's own executor

An executor rebuilds its wait set from Python objects before every wait, with two event handlers
per publisher and subscription in it; that is more than half of what a small message costs. Here
the set is kept, holds subscriptions, timers and one guard condition only, and a subscription that
is ready is emptied at once. The price is rclpy's private wait set, used in this module alone.
"""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.signals import SignalHandlerGuardCondition
from rclpy.subscription import Subscription

__all__ = ["Spin", "spin", "spin_executor", "spin_fast"]

Spin = Callable[[Node, Callable[[], bool]], None]

_WAIT_NS = 100_000_000
_WAIT_SET_METHODS = (
    "add_guard_condition",
    "add_subscription",
    "add_timer",
    "clear_entities",
    "get_ready_entities",
    "wait",
)


def spin(node: Node, done: Callable[[], bool]) -> None:
    """Execute a node's callbacks until ``done()`` holds after one of them.

    Args:
        node: the only node of its context; its callbacks are plain functions.
        done: asked after every batch of callbacks, at least every 0.1 s.

    Raises:
        ExternalShutdownException: the context was shut down, by a signal for instance.
    """
    if _can_spin_fast(node):
        spin_fast(node, done)
    else:
        spin_executor(node, done)


def spin_executor(node: Node, done: Callable[[], bool]) -> None:
    """Do what ``spin`` does, with nothing but rclpy's public interface."""
    executor = SingleThreadedExecutor(context=node.context)
    executor.add_node(node)
    try:
        with _shutdown_recognised(node):
            while not done():
                if not node.context.ok():
                    raise ExternalShutdownException
                executor.spin_once(timeout_sec=_WAIT_NS * 1e-9)
    finally:
        executor.remove_node(node)
        executor.shutdown()


def spin_fast(node: Node, done: Callable[[], bool]) -> None:
    """Do what ``spin`` does, for nodes without services and clients.

    Deviates: quality-of-service events (a warning about an incompatible peer) are not looked at.
    """
    loop = _Loop(node)
    try:
        with _shutdown_recognised(node):
            while not done():
                loop.turn()
    finally:
        loop.close()


@contextmanager
def _shutdown_recognised(node: Node) -> Iterator[None]:
    """Turn what rclpy raises when a signal shuts it down in the midst of anything into one kind."""
    try:
        yield
    except RuntimeError as error:
        if node.context.ok():
            raise
        raise ExternalShutdownException from error


def _can_spin_fast(node: Node) -> bool:
    wait_set = getattr(rclpy_implementation, "WaitSet", None)
    return all(hasattr(wait_set, name) for name in _WAIT_SET_METHODS) and not (
        [*node.services] or [*node.clients]
    )


class _Loop:
    """A wait set over one node's entities, rebuilt only when these change."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._context = node.context
        self._signal = SignalHandlerGuardCondition(self._context)
        self._subscriptions: list[Subscription] = []
        self._timers: list[Any] = []
        self._guards: list[Any] = []
        self._build()

    def close(self) -> None:
        """Give back the guard condition, before the context goes."""
        self._signal.destroy()

    def turn(self) -> None:
        """Wait for anything at all, at most 0.1 s, and execute what is ready."""
        node = self._node
        if [*node.subscriptions] != self._subscriptions or [*node.timers] != self._timers:
            self._build()
        wait_set = self._wait_set
        wait_set.clear_entities()
        for subscription in self._subscriptions:
            wait_set.add_subscription(subscription.handle)
        for timer in self._timers:
            wait_set.add_timer(timer.handle)
        for guard in self._guards:
            wait_set.add_guard_condition(guard.handle)
        wait_set.wait(_WAIT_NS)
        if not self._context.ok():
            raise ExternalShutdownException
        timers = wait_set.get_ready_entities("timer")
        ready = set(wait_set.get_ready_entities("subscription"))
        if timers:
            self._run_timers()
        for pointer, subscription in zip(self._pointers, self._subscriptions, strict=True):
            if pointer in ready:
                _drain(subscription)

    def _build(self) -> None:
        node = self._node
        self._subscriptions = [*node.subscriptions]
        self._timers = [*node.timers]
        self._guards = [self._signal, *node.guards]
        self._pointers = [subscription.handle.pointer for subscription in self._subscriptions]
        self._wait_set = rclpy_implementation.WaitSet(
            len(self._subscriptions),
            len(self._guards),
            len(self._timers),
            0,
            0,
            0,
            self._context.handle,
        )

    def _run_timers(self) -> None:
        for timer in self._timers:
            if timer.handle.is_timer_ready():
                timer.handle.call_timer()
                timer.callback()


def _drain(subscription: Subscription) -> None:
    take, kind, raw = subscription.handle.take_message, subscription.msg_type, subscription.raw
    callback = subscription.callback
    while (taken := take(kind, raw)) is not None:
        callback(taken[0])
