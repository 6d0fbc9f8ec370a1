"""Whose messages an agent takes.

``Attention``  to one other agent
"""

from collections.abc import Callable, Container

from rclpy.callback_groups import ReentrantCallbackGroup

__all__ = ["Attention"]


class Attention(ReentrantCallbackGroup):
    """Another agent's messages, taken while there is a point in it."""

    def __init__(self, other: str, attended: Callable[[], Container[str]]) -> None:
        """Attend to an agent as long as it is among those whom ``attended`` returns."""
        super().__init__()
        self._other = other
        self._attended = attended

    def can_execute(self, entity: object) -> bool:  # noqa: ARG002 (the group stands for it)
        """Tell whether the other's messages are to be taken now."""
        return self._other in self._attended()
