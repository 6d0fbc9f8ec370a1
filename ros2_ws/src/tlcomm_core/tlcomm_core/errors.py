"""Errors by meaning, so that a caller catches at the level that it can handle.

``TlcommError``
├── ``InputError``            what a user gave is wrong (exit status 2)
│   ├── ``ScenarioError``     a scenario or map file
│   └── ``FormulaError``      a formula's text
├── ``PlanningError``         the input is well-formed but no plan exists (exit status 2)
│   ├── ``IntractableTaskError``     the formula's automaton is too large
│   ├── ``UnsatisfiableTaskError``   no word at all satisfies the formula
│   └── ``UnreachableTaskError``     words exist, but the agent can't produce one
├── ``InfeasibleRoundError``  no admissible meeting exists in the window
└── ``LocalMisuseError``      our own code broke a precondition: a bug

What a *peer* does wrong never raises: it becomes a counted note.
"""

__all__ = [
    "FormulaError",
    "InfeasibleRoundError",
    "InputError",
    "IntractableTaskError",
    "LocalMisuseError",
    "PlanningError",
    "ScenarioError",
    "TlcommError",
    "UnreachableTaskError",
    "UnsatisfiableTaskError",
]


class TlcommError(Exception):
    """Base of every error that this project raises on purpose."""


class InputError(TlcommError):
    """What the user gave can't be used; the message is one line saying what, where and why."""


class ScenarioError(InputError):
    """A scenario or map file is malformed or describes an impossible world."""


class FormulaError(InputError):
    """A formula's text is malformed.

    Attributes:
        text: the formula as given.
        position: index into ``text`` of the offending character (``len(text)`` at its end).
    """

    def __init__(self, reason: str, text: str, position: int) -> None:
        """Keep the place beside the reason."""
        super().__init__(reason)
        self.text = text
        self.position = position


class PlanningError(TlcommError):
    """A well-formed task has no plan."""


class IntractableTaskError(PlanningError):
    """The formula's automaton is larger than the stated limits, so it isn't built."""


class UnsatisfiableTaskError(PlanningError):
    """No word satisfies the formula, whatever the agent does."""


class UnreachableTaskError(PlanningError):
    """Some word satisfies the formula, but none that this agent can produce."""


class InfeasibleRoundError(TlcommError):
    """No admissible meeting exists in the round's window."""


class LocalMisuseError(TlcommError):
    """Our own code broke a precondition: a bug, never a peer's or a user's doing."""
