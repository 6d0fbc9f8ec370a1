"""How sure a mean over repetitions is.

``Interval``       a mean with its 95 % interval
``mean_interval``  of some values
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

__all__ = ["Interval", "mean_interval"]

_RESAMPLES: Final = 2000
_SHARES: Final = (2.5, 97.5)


@dataclass(frozen=True, slots=True)
class Interval:
    """A mean, and between which values it lies with 95 % confidence."""

    mean: float
    low: float
    high: float


def mean_interval(values: Sequence[float]) -> Interval:
    """Return the mean of at least one value with its percentile bootstrap interval.

    The same values have the same interval. Of one value alone it is that value: nothing is known of
    how far others would be from it.
    """
    own = np.array(values, dtype=np.float64)
    rng = np.random.default_rng(0)
    means = own[rng.integers(len(own), size=(_RESAMPLES, len(own)))].mean(axis=1)
    low, high = np.percentile(means, _SHARES).tolist()
    return Interval(float(own.mean()), low, high)
