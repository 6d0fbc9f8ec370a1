"""What a bag says of the run that its brains were in, and whether that is enough.

``Setting``     scenario, method, solver and seed
``setting_of``  from a recording that holds all that its agents were told
"""

from collections.abc import Iterable
from dataclasses import dataclass
from itertools import pairwise
from typing import Final

from tlcomm_core.errors import InputError
from tlcomm_core.game.solver import SOLVERS, Solver
from tlcomm_core.method import Method
from tlcomm_core.pace import parse_pace
from tlcomm_core.scenario.loader import loads
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.units import NANOSECONDS_PER_SECOND, seconds
from tlcomm_core.world.observation import Connectivity
from tlcomm_tools.bag.topics import OPTIONAL_TOPICS, recorded_topics, split_topic
from tlcomm_tools.verification.recording import Recording

__all__ = ["Setting", "setting_of"]

_NOTES: Final = ("scenario", "method", "solver", "seed", "pace")
# Odometry of an agent at rest and connectivity come every second.
_LONGEST_GAP_NS: Final = NANOSECONDS_PER_SECOND


@dataclass(frozen=True, slots=True)
class Setting:
    """What a fresh brain is made from.

    Attributes:
        site: the scenario.
        method: of coordination.
        solver: of the rounds.
        seed: of what befalls agents and messages.
    """

    site: Site
    method: Method
    solver: Solver
    seed: int


def setting_of(recording: Recording) -> Setting:
    """Return what the bag's notes say, if agents can be told again all that they were told.

    Raises:
        InputError: a note is missing or wrong, the run wasn't in lock step, or something that
            agents were told is missing; the text names it.
    """
    notes = recording.run.notes
    for note in _NOTES:
        if note not in notes:
            raise InputError(f"the bag doesn't say its run's {note}, which verifying needs")
    _require_lock_step(notes["pace"])
    scenario = loads(notes["scenario"], "the bag's scenario")
    site = Site.from_scenario(scenario)
    _require_topics(recording, scenario)
    _require_maps(recording, site)
    _require_connectivity(recording, scenario)
    _require_odometry(recording, scenario)
    solver = _solver(notes["solver"])
    return Setting(site, recording.run.method, solver, _seed(notes["seed"]))


def _require_lock_step(text: str) -> None:
    if not parse_pace(text).is_lockstep:
        raise InputError(
            f"the run was at pace {text}: when agents heard what isn't recorded of a clock that "
            f"runs freely; verifying needs a run in lock step"
        )


def _require_topics(recording: Recording, scenario: Scenario) -> None:
    for topic in recorded_topics(scenario.agents, measures=scenario.field is not None):
        is_optional = split_topic(topic.name)[1] in OPTIONAL_TOPICS
        if topic.name not in recording.topics and not is_optional:
            raise InputError(f"the bag has no topic {topic.name!r}, which verifying needs")


def _require_maps(recording: Recording, site: Site) -> None:
    if not recording.maps:
        raise InputError("the bag has nothing on '/map', which verifying needs")
    for shown in recording.maps:
        if shown.free.shape != site.grid.shape:
            raise InputError(
                f"'/map' at {seconds(shown.stamp_ns):.3f} s has {shown.free.shape!r} cells, "
                f"expected {site.grid.shape!r} as in the scenario"
            )


def _require_connectivity(recording: Recording, scenario: Scenario) -> None:
    if recording.run.agents != tuple(scenario.agents):
        raise InputError(
            f"'/connectivity' is of {list(recording.run.agents)!r}, "
            f"expected the scenario's agents, {list(scenario.agents)!r}"
        )
    seen = recording.run.records.connectivity
    for own in seen:
        if not _is_sound(own, len(scenario.agents)):
            raise InputError(
                f"'/connectivity' at {seconds(own.stamp_ns):.3f} s isn't one of pairs of agents "
                f"with their distances"
            )
    _require_no_gap("/connectivity", (own.stamp_ns for own in seen), recording.end_ns)


def _is_sound(seen: Connectivity, count: int) -> bool:
    are_pairs = all(0 <= i < j < count for i, j in seen.edges)
    return are_pairs and len(seen.distances_m) == len(seen.edges)


def _require_odometry(recording: Recording, scenario: Scenario) -> None:
    for name in scenario.agents:
        stamps_ns = (own.stamp_ns for own in recording.run.records.odometry if own.agent == name)
        _require_no_gap(f"/{name}/odom", stamps_ns, recording.end_ns)


def _require_no_gap(topic: str, stamps_ns: Iterable[int], end_ns: int) -> None:
    """Refuse a topic on which something that comes every second is missing."""
    # What is due at the last instant may not have come any more.
    for begin_ns, then_ns in pairwise((0, *stamps_ns, end_ns - 1)):
        if then_ns - begin_ns > _LONGEST_GAP_NS:
            raise InputError(
                f"nothing on {topic!r} between {seconds(begin_ns):.3f} s and "
                f"{seconds(then_ns):.3f} s, which agents were told: the bag isn't whole"
            )


def _solver(name: str) -> Solver:
    if name not in SOLVERS:
        raise InputError(f"the bag's solver is {name!r}, expected one of {', '.join(SOLVERS)}")
    return SOLVERS[name]


def _seed(text: str) -> int:
    if not (text.isascii() and text.isdecimal()):
        raise InputError(f"the bag's seed is {text!r}, expected a whole number from 0 on")
    return int(text)
