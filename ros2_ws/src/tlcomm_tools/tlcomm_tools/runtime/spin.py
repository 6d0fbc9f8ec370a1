"""Spinning one node in one thread, fast.

``spin``           until done: by ``spin_fast`` where it can be, else by ``spin_executor``
``spin_fast``      one wait set, built once and refilled in place
``spin_executor``  rclpy's own executor

An executor rebuilds its wait set from Python objects before every wait, with two event handlers
per publisher and subscription in it; that is more than half of what a small message costs. Here
the set is kept, holds subscriptions, timers, services and guard conditions only, and a subscription
that is ready is emptied at once. The price is rclpy's private wait set, used in this module alone.

To wait for a subscription costs about as much as to take a message from it. A node that has many,
and need not act before one of them brings something, says so by a property ``urgent``: that
subscription, or ``None`` while it waits for all. Whenever it wakes up it is given what all of them
have brought, the urgent one's last.
"""

from collections.abc import Callable, Iterable, Iterator
from contextlib import contextmanager
from typing import Any

from rclpy.executors import ExternalShutdownException, SingleThreadedExecutor
from rclpy.impl.implementation_singleton import rclpy_implementation
from rclpy.node import Node
from rclpy.service import Service
from rclpy.signals import SignalHandlerGuardCondition
from rclpy.subscription import Subscription

__all__ = ["Spin", "spin", "spin_executor", "spin_fast"]

Spin = Callable[[Node, Callable[[], bool]], None]
# what takes a message, the message's type, whether as bytes, and who is given it
_Source = tuple[Callable[[Any, bool], Any], Any, bool, Callable[[Any], None]]

_WAIT_NS = 100_000_000
_WAIT_SET_METHODS = (
    "add_guard_condition",
    "add_service",
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
    """Do what ``spin`` does, for nodes without clients.

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
    return all(hasattr(wait_set, name) for name in _WAIT_SET_METHODS) and not [*node.clients]


class _Loop:
    """A wait set over one node's entities, rebuilt only when these change."""

    def __init__(self, node: Node) -> None:
        self._node = node
        self._context = node.context
        self._signal = SignalHandlerGuardCondition(self._context)
        self._build()

    def close(self) -> None:
        """Give back the guard condition, before the context goes."""
        self._signal.destroy()

    def turn(self) -> None:
        """Wait for anything at all, at most 0.1 s, and execute what is ready.

        Guard conditions come last, and those too that the other callbacks have triggered: they ask
        for what follows from all that came together.
        """
        if self._entities != self._present():
            self._build()
        urgent: Subscription | None = getattr(self._node, "urgent", None)
        self._wait(self._handles_to_wait_for(urgent))
        if urgent is None:
            for pointer in self._wait_set.get_ready_entities("subscription"):
                _drain(self._source_at[pointer])
        else:
            pointer = urgent.handle.pointer
            for other, source in self._source_at.items():
                if other != pointer:
                    _drain(source)
            _drain(self._source_at[pointer])
        if self._wait_set.get_ready_entities("timer"):
            self._run_timers()
        if self._services:
            self._run_services()
        if self._guards:
            self._run_guards()

    def _present(self) -> tuple[list[Subscription], list[Any], list[Any], list[Service]]:
        node = self._node
        return [*node.subscriptions], [*node.timers], [*node.guards], [*node.services]

    def _build(self) -> None:
        subscriptions, timers, guards, services = self._entities = self._present()
        self._subscriptions = [(s, s.handle, s.callback_group.can_execute) for s in subscriptions]
        self._source_at = {
            s.handle.pointer: (s.handle.take_message, s.msg_type, s.raw, s.callback)
            for s in subscriptions
        }
        self._timers = [(timer, timer.handle) for timer in timers]
        self._guards = {guard.handle.pointer: guard for guard in guards}
        self._services = {service.handle.pointer: service for service in services}
        self._guard_handles = [guard.handle for guard in (self._signal, *guards)]
        self._wait_set = self._wait_set_of(len(subscriptions), len(timers), len(services))
        self._guard_set = self._wait_set_of(0, 0, 0)

    def _wait_set_of(self, subscriptions: int, timers: int, services: int) -> Any:  # noqa: ANN401 (rclpy's)
        guards = len(self._guard_handles)
        return rclpy_implementation.WaitSet(
            subscriptions, guards, timers, 0, services, 0, self._context.handle
        )

    def _handles_to_wait_for(self, urgent: Subscription | None) -> list[Any]:
        if urgent is not None:
            return [urgent.handle]
        return [
            handle
            for subscription, handle, can_execute in self._subscriptions
            if can_execute(subscription)
        ]

    def _wait(self, subscriptions: Iterable[Any]) -> None:
        wait_set = self._wait_set
        wait_set.clear_entities()
        for handle in subscriptions:
            wait_set.add_subscription(handle)
        for _, handle in self._timers:
            wait_set.add_timer(handle)
        for service in self._services.values():
            wait_set.add_service(service.handle)
        self._wait_with_guards(wait_set, _WAIT_NS)
        if not self._context.ok():
            raise ExternalShutdownException

    def _wait_with_guards(self, wait_set: Any, at_most_ns: int) -> None:  # noqa: ANN401 (rclpy's)
        for handle in self._guard_handles:
            wait_set.add_guard_condition(handle)
        wait_set.wait(at_most_ns)

    def _run_timers(self) -> None:
        for timer, handle in self._timers:
            if handle.is_timer_ready():
                handle.call_timer()
                timer.callback()

    def _run_services(self) -> None:
        for pointer in self._wait_set.get_ready_entities("service"):
            _serve(self._services[pointer])

    def _run_guards(self) -> None:
        triggered = {*self._wait_set.get_ready_entities("guard_condition")}
        self._guard_set.clear_entities()
        self._wait_with_guards(self._guard_set, 0)
        triggered.update(self._guard_set.get_ready_entities("guard_condition"))
        for pointer, guard in self._guards.items():
            if pointer in triggered:
                guard.callback()


def _drain(source: _Source) -> None:
    take, kind, raw, callback = source
    while (taken := take(kind, raw)) is not None:
        callback(taken[0])


def _serve(service: Service) -> None:
    """Answer one request; more that wait make the service ready again."""
    request, header = service.handle.service_take_request(service.srv_type.Request)
    if header is not None:
        response = service.callback(request, service.srv_type.Response())
        service.send_response(response, header)
