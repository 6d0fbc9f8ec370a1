"""The cache holds the latest values within its bytes."""

import numpy as np
from numpy.typing import NDArray

from tlcomm_core.workspace.cache import BoundedCache


def block() -> NDArray[np.float64]:
    """Make a value of 64 bytes."""
    return np.zeros(8)


def test_a_held_value_is_returned_without_making_it_again() -> None:
    """A second get returns the same object."""
    cache = BoundedCache[str, NDArray[np.float64]](1000)
    assert cache.get("a", block) is cache.get("a", block)


def test_the_least_recently_used_value_goes_first() -> None:
    """With room for two, using the first again evicts the second."""
    cache = BoundedCache[str, NDArray[np.float64]](128)
    first, second = cache.get("a", block), cache.get("b", block)
    cache.get("a", block)
    cache.get("c", block)
    assert len(cache) == 2
    assert cache.get("a", block) is first
    assert cache.get("b", block) is not second


def test_one_value_larger_than_the_bound_is_held_alone() -> None:
    """A value above the bound evicts all others and stays."""
    cache = BoundedCache[str, NDArray[np.float64]](100)
    cache.get("a", block)
    large = cache.get("b", lambda: np.zeros(100))
    assert len(cache) == 1
    assert cache.get("b", block) is large


def test_it_tells_when_half_of_its_bytes_are_taken() -> None:
    """Below half of the bound it isn't half full, at half it is."""
    cache = BoundedCache[str, NDArray[np.float64]](256)
    cache.get("a", block)
    assert not cache.is_half_full
    cache.get("b", block)
    assert cache.is_half_full
