"""What was agreed on, and what came of it."""

import pytest

from support.hand_made_run import END_S, hand_made_records, hand_made_scenario
from tlcomm_core.method import Method
from tlcomm_tools.report.rounds import round_documents


def test_a_round_says_why_and_what_came() -> None:
    """Cost before and after, and of each member the detour, the planned wait and the real one."""
    first, second, third = round_documents(
        hand_made_scenario(), Method.TEAM, hand_made_records(), END_S
    )
    assert (first["round"], first["window_s"], first["held_by"]) == (
        1,
        (10.0, 20.0),
        ["east", "west"],
    )
    assert first["initial_potential_s"] == pytest.approx(first["potential_s"] + 1.0)
    east = first["members"][0]
    assert (east["agent"], east["place_m"], east["after_step"]) == ("east", (3.75, 0.25), 1)
    # As planned at 8 s; it came at 8 s, and waited until the window opened.
    assert (east["planned_wait_s"], east["detour_s"]) == (2.0, 0.5)
    assert (east["arrival_s"], east["wait_s"], east["additional_s"]) == (8.0, 2.0, 2.5)
    assert (first["started_s"], second["started_s"]) == (10.0, 20.0)
    assert (third["started_s"], third["members"][0]["wait_s"]) == (None, None)


def test_of_turns_there_is_only_the_plan() -> None:
    """A method without meetings has no windows that its turns belong to, and nobody waits."""
    first, *_ = round_documents(hand_made_scenario(), Method.ALL_TIME, hand_made_records(), END_S)
    assert (first["started_s"], first["members"][0]["planned_wait_s"]) == (None, 2.0)
    assert (first["members"][0]["arrival_s"], first["members"][0]["wait_s"]) == (None, None)
