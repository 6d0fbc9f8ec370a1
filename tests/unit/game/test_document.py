"""The round problem as a JSON document."""

import json
from typing import Any

import numpy as np
import pytest

from support.ruled_rounds import RULES, ruled_problem
from tlcomm_core.errors import InputError
from tlcomm_core.game.algorithm import Solution, solve
from tlcomm_core.game.document import parse_round, round_document
from tlcomm_core.game.problem import RoundProblem
from tlcomm_core.game.rules import PLAIN_RULES
from tlcomm_core.game.sample import sample_problem

Document = dict[str, Any]


@pytest.fixture
def problem() -> RoundProblem:
    """Return a feasible round of three agents."""
    return sample_problem(np.random.default_rng(2), 3, 6, 4, 3)


@pytest.fixture
def solution(problem: RoundProblem) -> Solution:
    """Return its solution."""
    return solve(problem)


@pytest.fixture
def document(problem: RoundProblem, solution: Solution) -> Document:
    """Return both as another program reads them."""
    text = json.dumps(round_document(problem, solution), allow_nan=False)
    read: Document = json.loads(text)
    return read


def test_a_document_keeps_the_problem(problem: RoundProblem, document: Document) -> None:
    """Written as strict JSON and read back, every number is the same."""
    parsed = parse_round(document)
    assert (parsed.round, parsed.window_s, parsed.range_m, parsed.agents) == (
        problem.round,
        problem.window_s,
        problem.range_m,
        problem.agents,
    )
    np.testing.assert_array_equal(parsed.locations_m, problem.locations_m)
    for ours, theirs in zip(problem.candidates, parsed.candidates, strict=True):
        np.testing.assert_array_equal(ours.task_index, theirs.task_index)
        np.testing.assert_array_equal(ours.arrival_s, theirs.arrival_s)
        np.testing.assert_array_equal(ours.extra_s, theirs.extra_s)


def test_a_document_keeps_links_and_rules() -> None:
    """What isn't in sight, and what the rules demand, is read back; none of it in older ones."""
    problem = ruled_problem(1, (3, 3, 4, 3), RULES["both"], is_blind=True)
    document = json.loads(json.dumps(round_document(problem, solve(problem))))
    parsed = parse_round(document)
    assert len(document["blind"]) > 0
    assert parsed.rules == problem.rules
    for place in range(len(problem.links)):
        assert parsed.links.near(place).tolist() == problem.links.near(place).tolist()
    for name in ("blind", "separation", "resilience"):
        del document[name]
    plain = parse_round(document)
    assert plain.rules == PLAIN_RULES
    assert plain.links.blind_pairs == ()


def test_a_document_has_the_names_of_the_contract(solution: Solution, document: Document) -> None:
    """The members that others read are there, and the solution's indices are ours."""
    assert document["format"] == "tlcomm-round/1"
    assert set(document) == {
        *("format", "round", "window", "range", "agents", "locations", "candidates"),
        *("blind", "separation", "resilience"),
        *("initial", "nash"),
    }
    assert set(document["candidates"][0]) == {"task_index", "arrival", "extra"}
    assert document["nash"] == {
        "location": list(solution.nash.location),
        "candidate": list(solution.nash.candidate),
        "potential": pytest.approx(solution.potentials_s[-1]),
    }
    assert document["initial"]["potential"] == pytest.approx(solution.potentials_s[0])


def test_inadmissible_entries_are_null(problem: RoundProblem, document: Document) -> None:
    """Null stands exactly where an entry is inadmissible."""
    own = problem.candidates[0]
    nulls = [[value is None for value in row] for row in document["candidates"][0]["arrival"]]
    assert nulls == (~np.isfinite(own.arrival_s)).tolist()
    assert np.any(nulls)


def test_a_parsed_problem_has_the_same_solution(solution: Solution, document: Document) -> None:
    """Another tool that reads the document finds the same equilibrium."""
    assert solve(parse_round(document)) == solution


def test_further_members_are_ignored(document: Document) -> None:
    """Other solvers' results under their own names do no harm."""
    parse_round({**document, "optimum": {"potential": 1.0}})


@pytest.mark.parametrize(
    ("path", "value", "complaint"),
    [
        (("format",), "tlcomm-round/2", "format: .*'tlcomm-round/2'"),
        (("round",), "three", "round: .*'three'"),
        (("range",), -1.0, "range: .*-1.0"),
        (("window",), [120.0, 60.0], r"window: .*\(120.0, 60.0\)"),
        (("agents",), ["b", "a", "c"], r"agents: .*\['b', 'a', 'c'\]"),
        (("agents",), ["a", "b"], "candidates: expected one table for each of 2 agents, not 3"),
        (("locations", 0), [1.0], r"locations\.0"),
        (("locations", 0, 1), float("nan"), r"locations\.0\.1: .*nan"),
        (("candidates", 1, "arrival", 0, 0), "soon", r"candidates\.1\.arrival\.0\.0: .*'soon'"),
        (("candidates", 1, "extra", 0), [], "candidates of agent_01: extra: expected"),
        (("candidates", 1, "extra", 0), [None] * 12, "agent_01: arrival and extra differ"),
        (("candidates", 2, "task_index", 0), 999, "agent_02: task_index isn't ascending"),
    ],
)
def test_malformed_documents_are_refused(
    document: Document, path: tuple[str | int, ...], value: object, complaint: str
) -> None:
    """Each error names the place and the value in one line."""
    parent: Any = document
    for part in path[:-1]:
        parent = parent[part]
    parent[path[-1]] = value
    with pytest.raises(InputError, match=complaint) as caught:
        parse_round(document)
    assert "\n" not in str(caught.value)
