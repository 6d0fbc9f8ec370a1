"""How far a comparison is."""

from io import StringIO

from tlcomm_core.method import Method
from tlcomm_tools.comparison.job import Job
from tlcomm_tools.comparison.progress import JobProgress


class FakeClock:
    """A clock that a test sets."""

    now_s = 0.0

    def __call__(self) -> float:
        """Return the time."""
        return self.now_s


def test_the_time_left_is_told_from_what_this_command_did() -> None:
    """By how long jobs take; what an earlier command did took none of it."""
    stream, clock = StringIO(), FakeClock()
    missing = [Job("", "", Method.TEAM, "", 0, 0.0, effort) for effort in (3.0, 2.0, 1.0, 4.0)]
    with JobProgress(missing, 2, stream, clock) as progress:
        clock.now_s = 5.0
        progress.show()
        progress.count(missing[1])
        progress.count(missing[0])
        clock.now_s = 40.0
        progress.show()
        clock.now_s = 44.0
        progress.show()
    assert stream.getvalue() == ("2/6 runs  0:05 min\n4/6 runs  0:40 min, about 0:40 min left\n")
