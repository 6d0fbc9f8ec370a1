"""A transition system reduced to what its runs can be read as.

``quotient``   the smallest system with the same words from bisimilar states
"""

from dataclasses import replace

import numpy as np

from tlcomm_core.planning.shortest_paths import Ints
from tlcomm_core.planning.transition_system import TransitionSystem

__all__ = ["quotient"]


def quotient(system: TransitionSystem) -> TransitionSystem:
    """Return a system with the same words, in which bisimilar states are one.

    How an agent is turned, for instance, makes no difference to what it may do next. Actions and
    times of its steps mean nothing.

    Source: Kanellakis and Smolka, "CCS expressions, finite state processes, and three problems of
        equivalence", 1990 (naive partition refinement).
    Cost: a sort of the steps in each round; most systems need three rounds.
    """
    classes = np.zeros(len(system.states), dtype=np.int64)
    count = 1
    while True:
        refined = _refined(system, classes)
        if refined.max() + 1 == count:
            return _merged(system, refined)
        classes, count = refined, refined.max() + 1


def _refined(system: TransitionSystem, classes: Ints) -> Ints:
    """Return finer classes: states that were in one and have the same steps to classes."""
    steps = _steps(system, system.source, classes)
    first = np.searchsorted(steps[:, 0], np.arange(len(classes) + 1))
    number: dict[tuple[int, bytes], int] = {}
    refined = [
        number.setdefault((own, steps[begin:end, 1:].tobytes()), len(number))
        for own, begin, end in zip(classes.tolist(), first[:-1], first[1:], strict=True)
    ]
    return np.array(refined, dtype=np.int64)


def _merged(system: TransitionSystem, classes: Ints) -> TransitionSystem:
    _, kept = np.unique(classes, return_index=True)
    steps = _steps(system, classes[system.source], classes)
    nothing = np.zeros(len(steps))
    return replace(
        system,
        states=tuple(system.states[state] for state in kept.tolist()),
        source=steps[:, 0],
        target=steps[:, 2],
        action=nothing.astype(np.int64),
        label=steps[:, 1],
        drive_s=nothing,
        drive_m=nothing,
        stay_s=nothing,
    )


def _steps(system: TransitionSystem, source: Ints, classes: Ints) -> Ints:
    """Return the distinct rows (source, label, class of the target), sorted."""
    rows: Ints = np.unique(np.column_stack((source, system.label, classes[system.target])), axis=0)
    return rows
