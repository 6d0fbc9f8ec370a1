"""Whatever a scenario file holds, it loads or fails with one line."""

from pathlib import Path

from hypothesis import given, settings
from hypothesis import strategies as st

from tlcomm_core.errors import ScenarioError
from tlcomm_core.scenario.loader import loads

CORRIDOR = (Path(__file__).parents[2] / "scenarios/corridor.yaml").read_text()
WORDS = sorted(
    {*CORRIDOR.split(), "[", "]", "{", "}", ":", "-", "&a", "*a", "!!set", "1e999", "''"}
)


def complaint(text: str) -> str:
    """Return what the loader says against a text, nothing if it loads."""
    try:
        loads(text, "x.yaml")
    except ScenarioError as error:
        return str(error)
    return ""


@settings(max_examples=100, deadline=None)
@given(st.data())
def test_a_damaged_scenario_never_fails_otherwise(data: st.DataObject) -> None:
    """With a piece cut out and another put in, the loader answers or complains in one line."""
    start = data.draw(st.integers(0, len(CORRIDOR)))
    end = data.draw(st.integers(start, min(start + 30, len(CORRIDOR))))
    piece = data.draw(st.one_of(st.text(max_size=10), st.sampled_from(WORDS)))
    said = complaint(CORRIDOR[:start] + piece + CORRIDOR[end:])
    assert len(said.splitlines()) <= 1


@settings(max_examples=100, deadline=None)
@given(st.lists(st.sampled_from([*WORDS, "\n", "\n  ", " "]), max_size=40))
def test_any_text_loads_or_fails_in_one_line(words: list[str]) -> None:
    """Words of a scenario in any order are no reason for another error."""
    said = complaint(" ".join(words))
    assert said.startswith("x.yaml:")
    assert len(said.splitlines()) == 1
