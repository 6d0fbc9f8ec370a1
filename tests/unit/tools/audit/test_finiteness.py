"""Whether what was recorded are numbers."""

import math
from dataclasses import replace

from support.hand_made_run import hand_made_records
from tlcomm_core.records import EstimateRecord
from tlcomm_tools.audit.finiteness import keep_finite


def test_finite_records_are_kept_as_they_are() -> None:
    """Nothing is named, nothing left out."""
    records = hand_made_records()
    assert keep_finite(records) == (records, ())


def test_what_is_not_finite_is_named_and_left_out() -> None:
    """Per agent and kind, with the first time, the value and how many there are."""
    records = hand_made_records()
    records.odometry[3] = replace(records.odometry[3], linear_mps=math.nan)
    who, when_s = records.odometry[3].agent, records.odometry[3].stamp_ns * 1e-9
    held = records.strategies[0]
    agreed_s = held.stamp_ns * 1e-9
    bad = replace(held, strategy=replace(held.strategy, potential_s=math.inf))
    records.strategies[0] = bad
    for time_s in (1, 2):
        estimate = EstimateRecord(time_s * 10**9, "west", -math.inf, 0.0, has_measurement=True)
        records.estimates.append(estimate)
    kept, lines = keep_finite(records)
    assert lines == (
        f"{who}: {when_s:.3f} s: odometry with nan, not a finite number, 1 in all",
        f"{held.agent}: {agreed_s:.3f} s: strategy with inf, not a finite number, 1 in all",
        "west: 1.000 s: estimate with -inf, not a finite number, 2 in all",
    )
    assert len(kept.odometry) == len(records.odometry) - 1
    assert len(kept.strategies) == len(records.strategies) - 1
    assert kept.estimates == []
