"""How far a comparison is."""

from io import StringIO

from tlcomm_tools.comparison.progress import JobProgress


class FakeClock:
    """A clock that a test sets."""

    now_s = 0.0

    def __call__(self) -> float:
        """Return the time."""
        return self.now_s


def test_the_time_left_is_told_from_what_this_command_did() -> None:
    """What an earlier one did took none of it."""
    stream, clock = StringIO(), FakeClock()
    with JobProgress(8, 2, stream, clock) as progress:
        clock.now_s = 5.0
        progress.show()
        progress.count()
        progress.count()
        clock.now_s = 40.0
        progress.show()
        clock.now_s = 44.0
        progress.show()
    assert stream.getvalue() == ("2/8 runs  0:05 min\n4/8 runs  0:40 min, about 1:20 min left\n")
