"""The cheapest common place, against a plain search of all places and arrivals."""

from collections.abc import Callable

import numpy as np
import pytest

from tlcomm_core.game.common_place import cheapest_common_place
from tlcomm_core.game.problem import Candidates, Profile, RoundProblem
from tlcomm_core.game.sample import sample_problem

MakeProblem = Callable[..., RoundProblem]


def searched(problem: RoundProblem) -> Profile | None:
    """Return the cheapest common place by trying every arrival at every place, in order."""
    opens_s, _ = problem.window_s
    best_s, best = np.inf, None
    for place in range(len(problem.locations_m)):
        since_s = [own.arrival_s[:, place] - opens_s for own in problem.candidates]
        extra_s = [own.extra_s[:, place] for own in problem.candidates]
        arrivals_s = np.maximum(np.concatenate(since_s), 0.0)
        for latest_s in np.unique(arrivals_s[np.isfinite(arrivals_s)]):
            potential_s, chosen = len(since_s) * latest_s, []
            for own_s, detour_s in zip(since_s, extra_s, strict=True):
                in_time = own_s <= latest_s
                gain_s = np.full(len(own_s), np.inf)
                gain_s[in_time] = detour_s[in_time] - own_s[in_time]
                chosen.append(int(np.argmin(gain_s)))
                potential_s += gain_s[chosen[-1]]
            if potential_s < best_s:
                best_s, best = potential_s, Profile((place,) * len(since_s), tuple(chosen))
    return best


def in_steps(problem: RoundProblem, step_s: float) -> RoundProblem:
    """Return a problem with all times rounded down to steps, so that many are equal."""
    opens_s, _ = problem.window_s
    candidates = tuple(
        Candidates(
            own.agent,
            own.task_index,
            opens_s + step_s * np.floor((own.arrival_s - opens_s) / step_s),
            step_s * np.floor(own.extra_s / step_s),
        )
        for own in problem.candidates
    )
    return RoundProblem(problem.round, problem.window_s, problem.links, candidates)


@pytest.mark.parametrize("seed", range(24))
def test_it_is_what_a_plain_search_finds(seed: int) -> None:
    """Place and candidates are the same, with equal times on the intervals' ends and without."""
    rng = np.random.default_rng(seed)
    problem = sample_problem(rng, 1 + seed % 12, 6, 7, 6)
    # A 64th of the window of 60 s, and 16 of these.
    for posed in (problem, in_steps(problem, 0.9375), in_steps(problem, 15.0)):
        assert cheapest_common_place(posed) == searched(posed)


def test_of_many_equal_places_it_is_the_lowest(make_problem: MakeProblem) -> None:
    """Place 1 of 50 wins, with other arrivals than the rest, though its bound isn't the least."""
    # Place 0 costs more. At place 1, one waits for the other; elsewhere both come at once.
    late = [(66.0, 9.0), (64.25, 1.0)] + [(61.5, 3.0)] * 48
    soon = [(66.0, 9.0), (62.25, 3.0)] + [(61.5, 3.0)] * 48
    problem = make_problem([(float(x), 0.0) for x in range(50)], 1.0, a=[late], b=[soon])
    assert cheapest_common_place(problem) == Profile((1, 1), (0, 0))


@pytest.mark.parametrize("arrival_s", [0.0, 59.999, 60.0, 60.9375, 90.0, np.nextafter(120.0, 0.0)])
def test_every_time_of_the_window_counts(make_problem: MakeProblem, arrival_s: float) -> None:
    """The only meeting is found whenever it is, also at an end of an interval of the search."""
    problem = make_problem([(0.0, 0.0)], 1.0, a=[[(arrival_s, 2.0)]], b=[[(arrival_s, 3.0)]])
    assert cheapest_common_place(problem) == Profile((0, 0), (0, 0))
