"""Tests of ``tlcomm_core.metrics.information_age``, by hand."""

import numpy as np
import pytest

from tlcomm_core.metrics.information_age import InformationAge, information_age
from tlcomm_core.units import nanoseconds
from tlcomm_core.world.observation import Connectivity


def ages(
    count: int, end_s: float, *states: tuple[float, tuple[tuple[int, int], ...]]
) -> InformationAge:
    """Return the ages with these links from these times (s) on."""
    found = information_age(
        [Connectivity(nanoseconds(t), edges, connected=False) for t, edges in states],
        count,
        nanoseconds(end_s),
    )
    assert found is not None
    return found


def test_a_connected_team_has_all_at_once() -> None:
    """Also over others: 0 and 2 hear each other through 1."""
    found = ages(3, 10.0, (0.0, ((0, 1), (1, 2))))
    assert not found.mean_s.any()
    assert not found.most_s.any()


def test_apart_the_age_grows_with_time() -> None:
    """Two that never hear each other: 8 s at the end, 4 s on average."""
    found = ages(2, 8.0, (0.0, ()))
    assert found.most_s.tolist() == [[0.0, 8.0], [8.0, 0.0]]
    assert found.mean_s.tolist() == [[0.0, 4.0], [4.0, 0.0]]


def test_a_contact_makes_it_new() -> None:
    """Apart for 6 s, together for 2 s, apart for 4 s: (18 + 0 + 8) s² in 12 s."""
    found = ages(2, 12.0, (0.0, ()), (6.0, ((0, 1),)), (8.0, ()))
    assert found.most_s[0, 1] == 6.0
    assert found.mean_s[0, 1] == pytest.approx(26.0 / 12.0)


def test_what_was_heard_is_passed_on() -> None:
    """1 hears 0 until 4 s and 2 from 6 s on: 2 has 0 as of 4 s, but 0 has 2 as of the start."""
    found = ages(3, 10.0, (0.0, ((0, 1),)), (4.0, ()), (6.0, ((1, 2),)))
    # Of 0: 18 s² until 6 s; then from 2 s to 6 s of age.
    assert found.mean_s[2, 0] == pytest.approx((18.0 + 16.0) / 10.0)
    assert found.most_s[2, 0] == 6.0
    assert found.mean_s[0, 2] == pytest.approx(5.0)
    assert found.most_s[0, 2] == 10.0


def test_who_joins_brings_the_newest_of_anybody() -> None:
    """Of 3, agent 0 has what 1 heard until 2 s, not what 2 has from the start."""
    found = ages(4, 9.0, (0.0, ((1, 3),)), (2.0, ()), (5.0, ((0, 1), (0, 2))))
    assert found.most_s[0, 3] == found.most_s[2, 3] == 9.0 - 2.0


def test_a_state_that_is_told_again_changes_nothing() -> None:
    """Nor does one whose links are others, but whose components aren't, nor one of no length."""
    plain = ages(3, 9.0, (1.0, ((0, 1), (1, 2))), (4.0, ()))
    told = ages(
        3,
        9.0,
        (1.0, ((0, 1), (1, 2))),
        (2.0, ((0, 1), (1, 2))),
        (3.0, ((0, 2), (1, 2))),
        (4.0, ((0, 1),)),
        (4.0, ()),
        (6.0, ()),
    )
    assert np.array_equal(plain.mean_s, told.mean_s)
    assert np.array_equal(plain.most_s, told.most_s)


def test_an_agents_ages_are_of_the_others() -> None:
    """The mean leaves out its own, which is 0."""
    found = ages(3, 8.0, (0.0, ((0, 1),)))
    assert found.mean_of_s(0) == pytest.approx((0.0 + 4.0) / 2.0)
    assert found.mean_of_s(2) == pytest.approx(4.0)
    assert found.most_of_s(0) == 8.0


def test_without_others_or_time_there_is_no_age() -> None:
    """One agent, no state of the links, or a run of no length."""
    seen = [Connectivity(0, (), connected=True)]
    assert information_age(seen, 1, 10) is None
    assert information_age([], 2, 10) is None
    assert information_age(seen, 2, 0) is None
