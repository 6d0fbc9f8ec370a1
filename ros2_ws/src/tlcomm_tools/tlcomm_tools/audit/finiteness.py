"""Whether what was recorded are numbers: whatever isn't finite is named, and left out.

``keep_finite``  the records that can be reckoned with, and what is wrong with the others
"""

import math
from collections.abc import Callable, Iterable, Iterator
from dataclasses import replace
from itertools import filterfalse
from typing import Final, Protocol, TypeVar

from tlcomm_core.records import EstimateRecord, OfferRecord, RunRecords, StrategyRecord
from tlcomm_core.world.observation import Odometry

__all__ = ["keep_finite"]


class _Stamped(Protocol):
    @property
    def stamp_ns(self) -> int: ...

    @property
    def agent(self) -> str: ...


_Own = TypeVar("_Own", bound=_Stamped)

# In any unit here, more than that is no measure of anything; its square is still finite.
_MOST: Final = 1e12


def keep_finite(records: RunRecords) -> tuple[RunRecords, tuple[str, ...]]:
    """Return the records without those that hold NaN or infinities, and a line per kind and agent.

    Nothing can be reckoned with them: a comparison with NaN holds for no violation. A number that
    is too large for any measure, and whose square might be infinite, is taken for infinite.
    """
    odometry, odometry_lines = _parted(records.odometry, _of_odometry, "odometry")
    strategies, strategy_lines = _parted(records.strategies, _of_strategy, "strategy")
    estimates, estimate_lines = _parted(records.estimates, _of_estimate, "estimate")
    offers, offer_lines = _parted(records.offers, _of_offer, "offer")
    kept = replace(
        records, odometry=odometry, strategies=strategies, estimates=estimates, offers=offers
    )
    return kept, (*odometry_lines, *strategy_lines, *estimate_lines, *offer_lines)


def _parted(
    entries: Iterable[_Own], numbers_of: Callable[[_Own], Iterator[float]], what: str
) -> tuple[list[_Own], list[str]]:
    """Return the finite ones, and a line for each agent with others."""
    kept: list[_Own] = []
    bad: dict[str, list[_Own]] = {}
    for entry in entries:
        if all(map(_is_measure, numbers_of(entry))):
            kept.append(entry)
        else:
            bad.setdefault(entry.agent, []).append(entry)
    return kept, [
        f"{agent}: {own[0].stamp_ns * 1e-9:.3f} s: {what} with "
        f"{_fault(next(filterfalse(_is_measure, numbers_of(own[0]))))}, {len(own)} in all"
        for agent, own in sorted(bad.items())
    ]


def _is_measure(number: float) -> bool:
    # NaN isn't less than anything.
    return abs(number) < _MOST


def _fault(number: float) -> str:
    return f"{number!r}, {'too large a' if math.isfinite(number) else 'not a finite'} number"


def _of_odometry(own: Odometry) -> Iterator[float]:
    yield from (own.pose.x_m, own.pose.y_m, own.pose.yaw_rad, own.linear_mps, own.angular_radps)


def _of_strategy(own: StrategyRecord) -> Iterator[float]:
    held = own.strategy
    yield from (held.communication_s, held.potential_s, held.initial_potential_s)
    for one in held.strategies:
        yield from (one.x_m, one.y_m, one.arrival_s, one.extra_travel_s)


def _of_offer(own: OfferRecord) -> Iterator[float]:
    offer = own.offer
    yield from (offer.arrival_s, offer.x_m, offer.y_m, offer.yaw_rad)
    yield from (offer.linear_mps, offer.angular_radps)
    for stop in offer.stops:
        yield from (stop.x_m, stop.y_m, stop.yaw_rad, stop.finish_offset_s)


def _of_estimate(own: EstimateRecord) -> Iterator[float]:
    yield from (own.value, own.last_measurement)
