"""Garbage in cycles is left until later, and not for ever."""

import gc

import pytest

from tlcomm_tools.collection import uncollected


@uncollected()
def fail() -> None:
    """Fail while nobody collects."""
    assert not gc.isenabled()
    raise ZeroDivisionError


def test_the_collector_rests_in_the_block_only() -> None:
    """Also if the block fails; and one that was off stays off."""
    assert gc.isenabled()
    with pytest.raises(ZeroDivisionError):
        fail()
    assert gc.isenabled()
    with uncollected():
        with uncollected():
            pass
        assert not gc.isenabled()
    assert gc.isenabled()
