"""Whether fresh brains do what was recorded, event by event.

``verify``        the first difference, and how much was compared
``Verification``  what was found
``Rehearsed``     how much of one agent was compared
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Final

from tlcomm_core.agent.controller import Pacing
from tlcomm_core.agent.member import create
from tlcomm_core.units import NANOSECONDS_PER_SECOND, seconds
from tlcomm_core.workspace.atlas import Atlas
from tlcomm_tools.verification.comparison import Comparison, Difference
from tlcomm_tools.verification.inputs import inputs_of
from tlcomm_tools.verification.outputs import Output, recorded_outputs
from tlcomm_tools.verification.recording import Recording
from tlcomm_tools.verification.rehearsal import rehearse
from tlcomm_tools.verification.setting import Setting, setting_of

__all__ = ["Rehearsed", "Verification", "verify"]

_FORMAT: Final = "tlcomm-verification/1"


@dataclass(frozen=True, slots=True)
class Rehearsed:
    """How much of one agent was compared.

    Attributes:
        agent: its name.
        instants: at how many it acted.
        outputs: how many recorded messages of its came out again.
    """

    agent: str
    instants: int
    outputs: int


@dataclass(frozen=True, slots=True)
class Verification:
    """What was found.

    Attributes:
        scenario: its name.
        method: of coordination.
        sim_s: simulated time that was recorded.
        agents: all, in the scenario's order; up to the first difference.
        difference: the first one, if any.
        note: what a reader should know beside, or "".
    """

    scenario: str
    method: str
    sim_s: float
    agents: tuple[Rehearsed, ...]
    difference: Difference | None
    note: str

    def document(self) -> dict[str, Any]:
        """Return it as a JSON document."""
        found = self.difference
        return {
            "format": _FORMAT,
            "scenario": self.scenario,
            "method": self.method,
            "sim_s": self.sim_s,
            "agents": {
                own.agent: {"instants": own.instants, "outputs": own.outputs} for own in self.agents
            },
            "difference": None if found is None else found.document(),
            "note": self.note or None,
            "verdict": "ok" if found is None else [str(found)],
        }


def verify(recording: Recording) -> Verification:
    """Tell fresh brains what was recorded, and compare what they do with what was done.

    Each agent is alone: what the others say to it is what they said then. So the first difference
    is where a decision fell otherwise, and not what followed from it.

    Raises:
        InputError: the bag doesn't hold all that its agents were told, or isn't of lock step.
        PlanningError: an agent's task has no plan.

    Cost: as simulating the run.
    """
    setting = setting_of(recording)
    atlas = Atlas(setting.site.grid, setting.site.region_discs)
    until_ns, first = recording.end_ns, None
    rehearsed = []
    for name in setting.site.scenario.agents:
        recorded = recorded_outputs(recording, name)
        heard_until_ns = recording.run.records.heard_until_ns.get(name)
        comparison = Comparison(name, recorded, recording.end_ns, heard_until_ns)
        instants = _rehearsal(name, setting, atlas, recording, until_ns)
        found = comparison.compare(instants, until_ns)
        rehearsed.append(Rehearsed(name, comparison.instants, comparison.outputs))
        if found is not None and (first is None or found.time_ns < first.time_ns):
            # Of the others, only what came before matters.
            until_ns, first = found.time_ns, found
    return Verification(
        scenario=setting.site.scenario.name,
        method=setting.method.value,
        sim_s=seconds(recording.end_ns),
        agents=tuple(rehearsed),
        difference=first,
        note="; ".join(_notes(recording, first)),
    )


def _notes(recording: Recording, first: Difference | None) -> Iterator[str]:
    if recording.run.damage:
        yield f"the bag was read only in part: {recording.run.damage}"
    if first is not None and recording.end_ns - first.time_ns < NANOSECONDS_PER_SECOND:
        yield "this is in the record's last second, which a killed recorder leaves incomplete"


def _rehearsal(
    name: str, setting: Setting, atlas: Atlas, recording: Recording, until_ns: int
) -> Iterator[tuple[int, list[Output]]]:
    site = setting.site
    member = create(name, site, Pacing.EVENT, atlas, setting.seed, setting.solver, setting.method)
    return rehearse(member, inputs_of(name, recording, site.scenario), until_ns)
