"""What an agent has done, and what it told."""

from support.hand_made_run import hand_made_records, task
from tlcomm_core.agent.actions import TaskEventKind
from tlcomm_tools.report.steps import done_steps, incidents


def test_steps_are_told_when_they_are_done() -> None:
    """Actions that ended and regions that were visited, with time and index."""
    own = [record for record in hand_made_records().tasks if record.agent == "east"]
    assert done_steps(own) == [(5.5, 0, "right", "pick"), (15.5, 1, "right", "pick")]
    visit = task(1.0, "east", TaskEventKind.REGION_VISITED, region="right", plan_index=3)
    assert done_steps([visit]) == [(1.0, 3, "right", "")]


def test_incidents_are_faults_and_changes() -> None:
    """A fault keeps its detail; what goes as planned is no incident."""
    assert incidents(hand_made_records().tasks) == []
    fault = task(1.0, "east", TaskEventKind.FAULT, detail="blocked=right")
    (own,) = incidents([fault])
    assert (own["time_s"], own["agent"], own["kind"]) == (1.0, "east", "fault")
    assert own["detail"] == "blocked=right"
