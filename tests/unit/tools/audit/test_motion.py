"""Whether an agent moved as it can."""

import math
from dataclasses import replace

import pytest

from support.hand_made_run import hand_made_scenario
from tlcomm_core.geometry import Pose
from tlcomm_core.scenario.model import Noise
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.observation import Odometry
from tlcomm_core.world.unicycle import integrate
from tlcomm_tools.audit.motion import audit_motion

# The limits are 1 m/s and 1.5 rad/s, the tolerance 0.02 m.
COMMANDS = ((1.0, 0.0), (0.0, 1.5), (-1.0, 0.0), (0.5, -1.5), (0.0, 0.0), (0.0, 0.0))


def driven(factor: float = 1.0) -> list[Odometry]:
    """Return the odometry of straights, turns and an arc, half a second each."""
    pose, samples = Pose(2.0, 0.5, 3.0), []
    for step, (linear, angular) in enumerate(COMMANDS):
        linear_mps, angular_radps = factor * linear, factor * angular
        stamp_ns = nanoseconds(0.5 * step)
        samples.append(Odometry(stamp_ns, "west", pose, linear_mps, angular_radps))
        pose = integrate(pose, linear_mps, angular_radps, 0.5)
    return samples


def found(samples: list[Odometry], noise: Noise | None = None) -> list[str]:
    """Return what is wrong."""
    scenario = hand_made_scenario().model_copy(update={"noise": noise or Noise()})
    return list(audit_motion(scenario, "west", samples))


def test_what_an_agent_can_is_fine() -> None:
    """At full speed, forwards, backwards and turning; so is nothing at all."""
    assert found(driven()) == []
    assert found([]) == []


def test_who_is_too_fast_is_named() -> None:
    """With time, speed, limit, and how often; a little more is the noise's doing if there is."""
    assert found(driven(1.2)) == [
        "west: 0.000 s: drives at 1.200 m/s, faster than 1 m/s; 2 times, at most 1.200 m/s",
        "west: 0.500 s: turns at 1.800 rad/s, faster than 1.5 rad/s; 2 times, at most 1.800 rad/s",
    ]
    assert found(driven(1.2), Noise(linear=0.05, angular=0.05)) == []
    assert len(found(driven(1.2), Noise(linear=0.05))) == 1
    assert len(found(driven(1.4), Noise(linear=0.05, angular=0.05))) == 2


@pytest.mark.parametrize(
    ("change", "lines"),
    [
        ({"x_m": 0.019}, []),
        (
            {"x_m": 0.3},
            ["west: 1.000 s: jumps by 0.300 m from where its velocity leads"],
        ),
        (
            {"yaw_rad": -0.1},
            ["west: 1.000 s: jumps in yaw by 0.100 rad from where its velocity leads"],
        ),
        ({"yaw_rad": math.tau}, []),
    ],
)
def test_a_jump_is_named(change: dict[str, float], lines: list[str]) -> None:
    """With time and how far; not what the tolerance covers, nor a whole turn."""
    samples = driven()
    for index in range(2, len(samples)):
        pose = samples[index].pose
        moved = replace(pose, **{name: getattr(pose, name) + by for name, by in change.items()})
        samples[index] = replace(samples[index], pose=moved)
    # Turned, all that follows would be driven elsewhere.
    assert found(samples[:3]) == lines
