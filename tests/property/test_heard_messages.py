"""Whole runs over bad radios: the audit finds nothing that an agent can't have heard."""

import numpy as np
import pytest

from support.changing_hall import changing_hall
from tlcomm_core.agent.radio import Radio
from tlcomm_core.method import Method
from tlcomm_core.mission import Mission
from tlcomm_core.pace import Pace
from tlcomm_core.records import RunRecords
from tlcomm_core.scenario import model
from tlcomm_core.scenario.generator import random_scenario
from tlcomm_core.scenario.model import Scenario
from tlcomm_core.scenario.site import Site
from tlcomm_core.simulation import simulate
from tlcomm_tools.audit.evidence import Evidence
from tlcomm_tools.audit.hearing import audit_hearing, unheard

BAD = model.Radio(loss=0.1, loss_at_range=0.4, jitter_s=0.05, duplication=0.2, bandwidth_bps=2e5)
LOCK_STEP = Pace(None)
TALKING = (Method.TEAM, Method.STATIC, Method.PAIRWISE, Method.ALL_TIME)
WINDOWS = 2


def left(scenario: Scenario, method: Method) -> tuple[RunRecords, float]:
    """Return what some windows leave, and when they end."""
    until_s = WINDOWS * scenario.communication.period_s
    mission = Mission(Site.from_scenario(scenario), 2, None, until_s, method=method)
    return simulate(mission).records, until_s


def over(scenario: Scenario, *, sees: bool) -> Scenario:
    """Return the scenario with the bad radio; ``sees``: that needs sight."""
    return scenario.model_copy(update={"radio": BAD.model_copy(update={"line_of_sight": sees})})


@pytest.mark.parametrize("method", TALKING)
def test_what_agents_hear_they_can_hear(method: Method) -> None:
    """Among obstacles, and in halls whose walls change, by every method that talks."""
    crowd = random_scenario(np.random.default_rng(1), agents=4, obstacle_share=0.12)
    halls = changing_hall(1), changing_hall(2)
    for scenario in (over(crowd, sees=True), *(over(hall, sees=True) for hall in halls)):
        records, end_s = left(scenario, method)
        evidence = Evidence.gather(scenario, records, end_s)
        assert records.heard
        assert list(audit_hearing(evidence, LOCK_STEP)) == []
        assert unheard(evidence, LOCK_STEP) == ()


def test_with_less_range_or_more_latency_some_could_not() -> None:
    """So the test above means something: by a slightly other scenario, there are violations."""
    crowd = over(random_scenario(np.random.default_rng(1), agents=4), sees=False)
    records, end_s = left(crowd, Method.TEAM)
    links = crowd.communication
    for changed in ({"range_m": 0.5 * links.range_m}, {"hop_latency_s": 0.05}):
        other = crowd.model_copy(update={"communication": links.model_copy(update=changed)})
        assert list(audit_hearing(Evidence.gather(other, records, end_s), LOCK_STEP))


def test_a_radio_that_lets_everything_through_is_found_out(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Agents then hear, and act upon, what was said out of range: the audit tells."""
    monkeypatch.setattr(Radio, "_distance_m", lambda *_: 0.5)
    crowd = random_scenario(np.random.default_rng(1), agents=4)
    records, end_s = left(crowd, Method.PAIRWISE)
    found = list(audit_hearing(Evidence.gather(crowd, records, end_s), LOCK_STEP))
    assert found
    assert all(line.rpartition("away, ")[2].startswith("out of range") for line in found)
