"""The promise of whole teams: in every window all are connected for D_c.

``keep_windows``  whether they were
"""

from tlcomm_tools.audit.evidence import Evidence
from tlcomm_tools.audit.guarantees.guarantee import Guarantee
from tlcomm_tools.table import format_number

__all__ = ["keep_windows"]


def keep_windows(evidence: Evidence) -> Guarantee:
    """Say which windows weren't kept."""
    links, windows = evidence.scenario.communication, evidence.windows
    kept = sum(own.satisfied for own in windows)
    shortest_s = min((own.longest_s for own in windows), default=None)
    return Guarantee(
        promise="the team is connected for D_c in every window",
        shown={
            "windows kept": f"{kept} of {len(windows)}, by the poses",
            "shortest meeting": format_number(shortest_s, 3, "s"),
        },
        figures={"windows": len(windows), "windows_kept": kept, "shortest_s": shortest_s},
        violations=tuple(
            f"window {own.round}: connected for {own.longest_s:.3f} s from "
            f"[{own.round * links.period_s:g} s, {(own.round + 1) * links.period_s:g} s) on, "
            f"not {links.duration_s:g} s"
            for own in windows
            if not own.satisfied
        ),
    )
