"""Tests of ``tlcomm_tools.figures.courses``."""

from itertools import pairwise

import pytest

from tlcomm_tools.figures.trace import Trace


def test_a_course_begins_where_the_run_did(trace: Trace) -> None:
    """Φ of S⁰ is what agents have recorded, and what they agreed on is below the course's end."""
    assert [course.round for course in trace.courses] == [1, 2]
    for course, agreement in zip(trace.courses, trace.agreements[:2], strict=True):
        assert course.potentials_s[0] == pytest.approx(agreement.initial_s)
        assert agreement.agreed_s <= course.potentials_s[-1] + 1e-9


def test_a_course_falls_with_every_move(trace: Trace) -> None:
    """Nobody moves without gain."""
    for course in trace.courses:
        assert len(course.potentials_s) > 5
        assert all(later < earlier for earlier, later in pairwise(course.potentials_s))
