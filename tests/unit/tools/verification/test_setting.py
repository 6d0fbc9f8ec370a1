"""Tests of ``tlcomm_tools.verification.setting``: recordings that can't be verified."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest

from tlcomm_core.errors import InputError
from tlcomm_core.method import Method
from tlcomm_core.units import nanoseconds
from tlcomm_tools.verification.recording import MapShown, Recording
from tlcomm_tools.verification.setting import setting_of

FROM_NS, TO_NS = nanoseconds(5.0), nanoseconds(8.0)


def set_note(name: str, text: str) -> Callable[[Recording], None]:
    """Return what changes a note."""
    return lambda recording: recording.run.notes.update({name: text})


def drop_topic(recording: Recording) -> None:
    """Let a topic be missing."""
    recording.topics -= {"/two/confirmation"}


def drop_maps(recording: Recording) -> None:
    """Let there be no map."""
    recording.maps.clear()


def shrink_map(recording: Recording) -> None:
    """Let a map be of another place."""
    recording.maps[0] = MapShown(0, np.ones((2, 3), dtype=np.bool_))


def drop_odometry(recording: Recording) -> None:
    """Let some of an agent's odometry be missing."""
    records = recording.run.records
    records.odometry = [
        own for own in records.odometry if own.agent != "two" or not FROM_NS < own.stamp_ns < TO_NS
    ]


def drop_connectivity(recording: Recording) -> None:
    """Let the last of the connectivity be missing."""
    records = recording.run.records
    records.connectivity = [own for own in records.connectivity if own.stamp_ns < TO_NS]


def drop_distances(recording: Recording) -> None:
    """Let it not be known how far apart agents are."""
    seen = recording.run.records.connectivity
    seen[0] = replace(seen[0], distances_m=())


def rename_agents(recording: Recording) -> None:
    """Let the connectivity be of others."""
    recording.run = replace(recording.run, agents=("one", "three"))


@pytest.mark.parametrize(
    ("spoil", "complaint"),
    [
        (lambda recording: recording.run.notes.pop("seed"), "doesn't say its run's seed"),
        (set_note("pace", "5.0"), "was at pace 5.0: .* needs a run in lock step"),
        (set_note("pace", "slow"), "pace: 'slow'"),
        (set_note("method", "magic"), "method: 'magic'"),
        (set_note("solver", "magic"), "solver is 'magic', expected one of"),
        (set_note("seed", "-1"), "seed is '-1'"),
        (set_note("scenario", "name: 7"), "the bag's scenario"),
        (drop_topic, "no topic '/two/confirmation'"),
        (drop_maps, "nothing on '/map'"),
        (shrink_map, r"'/map' at 0.000 s has \(2, 3\) cells"),
        (drop_odometry, "nothing on '/two/odom' between (4.5|5.0)00 s and 8.[0-9]* s"),
        (drop_connectivity, "nothing on '/connectivity' between 7.* s and "),
        (drop_distances, "'/connectivity' at 0.000 s isn't one of pairs"),
        (rename_agents, r"'/connectivity' is of \['one', 'three'\]"),
    ],
)
def test_what_is_missing_or_wrong_is_named(
    recording: Recording, spoil: Callable[[Recording], object], complaint: str
) -> None:
    """One line says what, and from when to when."""
    spoil(recording)
    with pytest.raises(InputError, match=complaint) as caught:
        setting_of(recording)
    assert "\n" not in str(caught.value)


def test_a_whole_recording_says_what_its_brains_were_made_from(recording: Recording) -> None:
    """Scenario, method, solver and seed are those of the run."""
    setting = setting_of(recording)
    assert (setting.method, setting.solver.name, setting.seed) == (Method.TEAM, "coalition", 0)
    assert tuple(setting.site.scenario.agents) == recording.run.agents
