"""The part of ``replay`` that decides again what was decided.

``verify_run``  verifies a run's decisions and shows what was found
"""

from pathlib import Path

from tlcomm_core.errors import InputError
from tlcomm_tools.status import Status
from tlcomm_tools.table import format_table
from tlcomm_tools.verbs.options import print_json
from tlcomm_tools.verification.findings import Verification, verify
from tlcomm_tools.verification.recording import read_recording

__all__ = ["verify_run"]


def verify_run(path: Path, *, as_json: bool) -> Status:
    """Verify a run's decisions from its bag; show the first that falls otherwise.

    Args:
        path: a run's folder, a bag's folder or MCAP file.
        as_json: whether to print a JSON document.

    Raises:
        InputError: there is no bag, or it can't be verified; the text names it.
    """
    try:
        verification = verify(read_recording(path))
    except InputError as error:
        shown = repr(str(path))
        raise InputError(str(error) if shown in str(error) else f"{shown}: {error}") from error
    if as_json:
        print_json(verification.document())
    else:
        print(_format(verification))
    return Status.FINE if verification.difference is None else Status.PROPERTY_FAILED


def _format(verification: Verification) -> str:
    rows = [(own.agent, str(own.instants), str(own.outputs)) for own in verification.agents]
    whose = f"{verification.scenario}, method {verification.method}"
    parts = [
        f"{whose}: decisions of {verification.sim_s:.1f} s",
        "",
        format_table(("agent", "acted", "messages equal"), rows),
        "",
    ]
    if verification.note:
        parts.append(f"note: {verification.note}")
    if verification.difference is None:
        return "\n".join([*parts, "verdict: ok"])
    return "\n".join([*parts, "verdict: FAILED", f"  - {verification.difference}"])
