"""A small scenario's text with nothing wrong in it, for tests that change one thing each."""

from typing import Final

__all__ = ["GOOD"]

GOOD: Final = """\
name: small
workspace:
  size_m: [4.0, 4.0]
  cell_m: 0.5
  obstacles_m:
    - [1.0, 1.0, 2.0, 2.0]
    - [3.0, 0.0, 3.2, 4.0]
  regions:
    a: {at_m: [0.25, 0.25], radius_m: 0.5}
    b: {at_m: [2.25, 3.25], radius_m: 0.5}
communication: {range_m: 1.0, period_s: 60.0, duration_s: 5.0}
motion: {linear_mps: 1.0, angular_radps: 1.5}
actions: {pick: 4.0}
agents:
  one:
    start: [0.25, 0.75, 0.0]
    task: "G F (a & pick)"
  two:
    start: [0.75, 0.75, 0]
    task: "G F b"
    motion: {linear_mps: 0.5}
    actions: {pick: 1.0, drop: 2}
"""
