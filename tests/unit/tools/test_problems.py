"""Tests of ``tlcomm_tools.problems``: the problems that are measured have the sizes claimed."""

from tlcomm_core.ltl import parse, translate
from tlcomm_core.planning.product import build
from tlcomm_core.planning.synthesis import plan_task
from tlcomm_tools.problems import PROBLEMS, neighbour_grid


def test_on_a_grid_the_best_cycle_is_its_shortest_round() -> None:
    """From corner to corner, all three, and back: 4·(n - 1) moves."""
    plan = plan_task(parse("G F a & G F b & G F c"), neighbour_grid(6))
    assert plan.suffix_s == 20.0
    assert plan.suffix_m == 20.0


def test_the_problems_reach_a_hundred_thousand_states() -> None:
    """The largest product is of that size."""
    largest = max(PROBLEMS[:5], key=lambda problem: len(problem.make().states))
    assert build(largest.make(), translate(parse(largest.task))).size > 10**5 * 0.99
