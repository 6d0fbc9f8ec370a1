"""Tests of ``tlcomm_tools.figures.trace``."""

import json
import subprocess
import sys

import pytest

from tlcomm_core.errors import InputError
from tlcomm_core.scenario.site import Site
from tlcomm_tools.figures.trace import Trace


def test_a_trace_is_the_same_after_a_way_through_json(trace: Trace) -> None:
    """Its document says what it is."""
    text = trace.to_json()
    assert Trace.from_json(text) == trace
    assert json.loads(text)["format"] == "tlcomm-trace/1"


def test_a_trace_is_small(trace: Trace) -> None:
    """Two rounds of eight agents make less than some 40 kB."""
    assert len(trace.to_json()) < 40_000


def test_a_trace_has_what_is_drawn(trace: Trace, plant: Site) -> None:
    """All agents in the order of the team, all meetings, windows and estimates."""
    team = tuple(plant.scenario.agents)
    assert tuple(trace.paths) == tuple(trace.spans) == tuple(trace.satisfied_s) == team
    assert [meeting.round for meeting in trace.meetings] == [1, 2]
    assert all(len(meeting.links) >= len(team) - 1 for meeting in trace.meetings)
    assert [own.round for own in trace.additional_times] == [1, 2]
    assert trace.missed_rounds == ()
    assert tuple(trace.estimates) == ("agent_1", "agent_2")
    assert trace.field is not None


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"format": "tlcomm-trace/0"}, "trace: format: Input should be 'tlcomm-trace/1'"),
        ({"end_s": "long"}, "trace: end_s: Input should be a valid number"),
        ({"spans": {}}, "trace: document: Value error, spans isn't of the agents agent_1"),
        (
            {"estimates": {"nobody": {"times_s": [], "values": []}}},
            "trace: document: Value error, nobody has no path",
        ),
        ({"extra": 1}, "trace: extra: Extra inputs are not permitted"),
    ],
)
def test_a_flawed_document_is_refused(
    trace: Trace, change: dict[str, object], message: str
) -> None:
    """The message names the place."""
    document = json.loads(trace.to_json()) | change
    with pytest.raises(InputError) as refused:
        Trace.from_json(json.dumps(document))
    assert str(refused.value).startswith(message)


def test_what_is_no_json_is_refused() -> None:
    """With one clear line."""
    with pytest.raises(InputError, match="trace: document: Invalid JSON"):
        Trace.from_json("{")


def test_a_trace_is_made_without_matplotlib() -> None:
    """What doesn't draw doesn't wait for it."""
    code = (
        "import sys, tlcomm_tools.figures.courses, tlcomm_tools.figures.trace;"
        "sys.exit('matplotlib' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0
