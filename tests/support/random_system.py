"""Transition systems of a few states at random, without a workspace behind them."""

import numpy as np

from tlcomm_core.geometry import Pose
from tlcomm_core.planning.transition_system import State, TransitionSystem

__all__ = ["PLACES", "random_system"]

PLACES = "abc"


def random_system(seed: int) -> TransitionSystem:
    """Return three places, four states and a few steps between them, some of which act."""
    rng = np.random.default_rng(seed)
    places = [0, *rng.integers(0, 3, 3).tolist()]
    source = np.sort(np.concatenate((np.arange(4), rng.integers(0, 4, int(rng.integers(2, 6))))))
    target = rng.integers(0, 4, len(source))
    at_rest = np.array(places)[source] == np.array(places)[target]
    action = np.where(at_rest, rng.integers(0, 2, len(source)), 0)
    letters = [frozenset({place, "w"} if acts else {place}) for place in PLACES for acts in (0, 1)]
    return TransitionSystem(
        states=tuple(State(place, Pose(place, 0.0, yaw)) for yaw, place in enumerate(places)),
        regions={place: (name,) for place, name in enumerate(PLACES)},
        actions=(None, "w"),
        labels=tuple(letters),
        initial_label=0,
        source=source,
        target=target,
        action=action,
        label=2 * np.array(places)[target] + action,
        drive_s=np.zeros(len(source)),
        drive_m=np.zeros(len(source)),
        stay_s=rng.integers(1, 5, len(source)).astype(float),
    )
