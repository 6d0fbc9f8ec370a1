"""Simulated runs of every method, judged by the independent audit."""

from functools import cache
from itertools import permutations

import pytest

from support.command import CORRIDOR
from tlcomm_core.game.solver import DEFAULT
from tlcomm_core.method import Method
from tlcomm_core.mission import Mission
from tlcomm_core.scenario.loader import load_scenario
from tlcomm_core.scenario.model import Faults, Radio, Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import Simulated, simulate
from tlcomm_tools.audit.findings import audit_run
from tlcomm_tools.comparison.perturbation import perturbed

WINDOWS = 6.3
SCENARIO = load_scenario(CORRIDOR)
FAULTY = SCENARIO.model_copy(update={"faults": Faults(action_failure=0.2)})
APART = SCENARIO.model_copy(
    update={"communication": SCENARIO.communication.model_copy(update={"separation_m": 0.4})}
)
LOSSY = SCENARIO.model_copy(update={"radio": Radio(loss=0.2, jitter_s=0.02)})
# What the run of one method happens to keep of what another promises.
KEPT_AS_WELL = {
    (Method.ORACLE, Method.TEAM),
    (Method.STATIC, Method.TEAM),
    (Method.STATIC, Method.ORACLE),
    (Method.TEAM, Method.ORACLE),
}


def run(scenario: Scenario, method: Method) -> Simulated:
    """Simulate a few windows; the last is cut."""
    until_s = WINDOWS * scenario.communication.period_s
    solver = method.solver(DEFAULT)
    return simulate(Mission(Site.from_scenario(scenario), 0, None, until_s, solver, method))


@cache
def plain_run(method: Method) -> Simulated:
    """Simulate the scenario as it is."""
    return run(SCENARIO, method)


@pytest.mark.parametrize("method", list(Method))
@pytest.mark.parametrize(
    "scenario",
    [FAULTY, LOSSY, APART, perturbed(SCENARIO, 1), perturbed(SCENARIO, 2)],
    ids=["faulty", "lossy", "apart", "perturbed", "perturbed otherwise"],
)
def test_each_method_keeps_its_promises(scenario: Scenario, method: Method) -> None:
    """Whatever fails, is lost or starts elsewhere."""
    left = run(scenario, method)
    assert audit_run(scenario, method, left.records, left.sim_ns).violations == ()


@pytest.mark.parametrize("method", list(Method))
def test_something_was_promised(method: Method) -> None:
    """Windows, meetings of pairs, turns: there is more than one of each to be kept."""
    left = plain_run(method)
    found = audit_run(SCENARIO, method, left.records, left.sim_ns)
    assert found.violations == ()
    assert len(found.windows) >= 6
    assert sum(own.satisfied or 0 for own in found.tasks) > len(SCENARIO.agents)
    assert found.strategies.rounds == found.strategies.equal
    assert (found.strategies.rounds > 4) is (method is not Method.NONE)


@pytest.mark.parametrize(("done", "judged"), [*permutations(Method, 2)])
def test_each_method_keeps_only_its_own(done: Method, judged: Method) -> None:
    """A run of one method fails the audit as another's, unless that promises less."""
    left = plain_run(done)
    violations = audit_run(SCENARIO, judged, left.records, left.sim_ns).violations
    assert (violations == ()) is ((done, judged) in KEPT_AS_WELL)
