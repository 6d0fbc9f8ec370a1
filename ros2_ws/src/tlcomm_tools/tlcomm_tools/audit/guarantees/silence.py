"""The promise of agents by themselves: nobody meets.

``stay_silent``  whether nobody did
"""

from typing import Final

from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_tools.audit.evidence import Evidence
from tlcomm_tools.audit.guarantees.guarantee import Guarantee

__all__ = ["stay_silent"]

_COMMUNICATING: Final = {
    TaskEventKind.MEETING_REACHED,
    TaskEventKind.MEETING_STARTED,
    TaskEventKind.MEETING_ENDED,
    TaskEventKind.ROUND_AGREED,
}


def stay_silent(evidence: Evidence) -> Guarantee:
    """Say who met, or agreed on a meeting."""
    records = evidence.records
    met = [record for record in records.tasks if record.event.kind in _COMMUNICATING]
    return Guarantee(
        promise="nobody meets",
        shown={"meetings": str(len(met)) if met else "none"},
        figures={"meetings": len(met), "strategies": len(records.strategies)},
        violations=(
            *(
                f"{record.agent}: {record.stamp_ns * 1e-9:.3f} s: {record.event.kind.name}, "
                "though nobody meets"
                for record in met
            ),
            *(
                f"{record.agent}: holds a strategy for round {record.strategy.round}, "
                "though nobody meets"
                for record in records.strategies
            ),
        ),
    )
