"""A recorded run that the tests share; each gets a copy of its own to change."""

from copy import copy, deepcopy
from dataclasses import replace

import pytest

from support.gate import gate
from support.recorded_simulation import record
from tlcomm_core.mission import Mission
from tlcomm_core.scenario.site import Site
from tlcomm_tools.verification.recording import Recording


@pytest.fixture(scope="package")
def gate_run() -> Recording:
    """Return two agents' run through the gate: three meetings, and a map that changes."""
    return record(Mission(Site.from_scenario(gate()), 0, 2, None))


@pytest.fixture
def recording(gate_run: Recording) -> Recording:
    """Return a copy of that run, of which a test may change anything."""
    own = copy(gate_run)
    own.run = replace(own.run, records=deepcopy(own.run.records), notes=dict(own.run.notes))
    own.said, own.commanded, own.maps = [*own.said], [*own.commanded], [*own.maps]
    return own
