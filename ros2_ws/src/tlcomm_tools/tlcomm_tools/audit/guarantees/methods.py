"""Which promises a method of coordination makes.

``audit_guarantees``  all of a method's, as they were found
"""

from collections.abc import Callable, Mapping
from typing import Final

from tlcomm_core.method import Method
from tlcomm_tools.audit.evidence import Evidence
from tlcomm_tools.audit.guarantees.connection import stay_connected
from tlcomm_tools.audit.guarantees.guarantee import Guarantee
from tlcomm_tools.audit.guarantees.pairs import meet_in_pairs
from tlcomm_tools.audit.guarantees.places import keep_places
from tlcomm_tools.audit.guarantees.schedule import keep_schedule
from tlcomm_tools.audit.guarantees.silence import stay_silent
from tlcomm_tools.audit.guarantees.turns import take_turns
from tlcomm_tools.audit.guarantees.windows import keep_windows

__all__ = ["audit_guarantees"]

_PROMISES: Final[Mapping[Method, tuple[Callable[[Evidence], Guarantee], ...]]] = {
    Method.TEAM: (keep_windows,),
    Method.STATIC: (keep_windows, keep_places),
    Method.ORACLE: (keep_windows,),
    Method.ALL_TIME: (stay_connected, take_turns),
    Method.PAIRWISE: (meet_in_pairs, keep_schedule),
    Method.NONE: (stay_silent,),
}


def audit_guarantees(method: Method, evidence: Evidence) -> tuple[Guarantee, ...]:
    """Return what a method promises, and what was found of it."""
    return tuple(promise(evidence) for promise in _PROMISES[method])
