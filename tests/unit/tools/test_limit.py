"""When a run ends at the latest."""

import pytest

from support.hall import DURATION_S, PERIOD_S, hall
from tlcomm_core.method import Method
from tlcomm_tools.limit import time_limit_s


def test_a_lost_meeting_ends_a_run() -> None:
    """The last one can't begin any more, and D_c after that is spare."""
    assert time_limit_s(hall(1).scenario, 3, None) == 4 * PERIOD_S + DURATION_S + 1.0


@pytest.mark.parametrize("method", [Method.ALL_TIME, Method.PAIRWISE, Method.NONE])
def test_where_no_windows_are_met_in_a_run_ends_with_the_last(method: Method) -> None:
    """Nothing is waited for."""
    assert time_limit_s(hall(1).scenario, 3, None, method) == 4 * PERIOD_S


def test_a_time_asked_for_is_the_end() -> None:
    """Whatever the method."""
    assert time_limit_s(hall(1).scenario, None, 7.5, Method.ALL_TIME) == 7.5
