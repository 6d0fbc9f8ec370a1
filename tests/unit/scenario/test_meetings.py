"""What a scenario demands of meetings."""

import pytest

from support.hall import hall
from tlcomm_core.scenario.meetings import check_meetings

HALL = hall(3).scenario
# Links are planned with 0.96 m, and cells are 0.5 m wide.
_ROOM = {
    "no separation": (1.0, 0.0, 1, True),
    "one cell apart": (1.0, 0.5, 0, True),
    "across a cell": (1.0, 0.7, 0, True),
    "nothing in between": (1.0, 0.75, 0, False),
    "a triangle": (1.0, 0.5, 1, True),
    "a pair, but no triangle": (1.1, 1.0, 1, False),
    "a pair": (1.1, 1.0, 0, True),
}


@pytest.mark.parametrize("name", _ROOM)
def test_cells_have_to_leave_room(name: str) -> None:
    """Two centres far enough apart and near enough, or three when nobody may be needed."""
    range_m, separation_m, resilience, is_fine = _ROOM[name]
    demands = {"range_m": range_m, "separation_m": separation_m, "resilience": resilience}
    communication = HALL.communication.model_copy(update=demands)
    found = list(check_meetings(HALL.model_copy(update={"communication": communication})))
    assert (not found) == is_fine
    assert all(finding.place == ("communication", "separation_m") for finding in found)


def test_two_agents_need_no_triangle() -> None:
    """A team of two falls apart whichever of them fails."""
    two = hall(2).scenario
    demands = {"range_m": 1.1, "separation_m": 1.0, "resilience": 1}
    communication = two.communication.model_copy(update=demands)
    assert not list(check_meetings(two.model_copy(update={"communication": communication})))
