"""YAML as plain values with lines."""

import pytest

from tlcomm_core.errors import ScenarioError
from tlcomm_core.scenario.document import MAX_BYTES, MAX_DEPTH, parse_yaml, place_text


def test_plain_values_of_all_kinds() -> None:
    """Text, numbers, true, false and null follow YAML 1.2; quotes make text."""
    text = b"""
a: [1, -2.5, 1e3, .5, true, null, ~]
b: {yes: no, quoted: "1.0", time: 1:30, octal: 010}
c:
"""
    assert parse_yaml(text, "x").root == {
        "a": [1, -2.5, 1000.0, 0.5, True, None, None],
        "b": {"yes": "no", "quoted": "1.0", "time": "1:30", "octal": 10},
        "c": None,
    }


def test_every_key_and_item_knows_its_line() -> None:
    """What is missing has the line of what it would stand in."""
    document = parse_yaml(b"a:\n  b:\n    - 1\n    - c: 2\nd: 3\n", "x")
    assert document.line_of(("a",)) == 1
    assert document.line_of(("a", "b")) == 2
    assert document.line_of(("a", "b", 1)) == 4
    assert document.line_of(("a", "b", 1, "c")) == 4
    assert document.line_of(("a", "missing", "deeper")) == 1
    assert document.line_of(("d",)) == 5


def test_places_read_as_people_write_them() -> None:
    """Keys by dots, indices in brackets; odd keys are quoted, so that a place is one line."""
    assert place_text(("a", "b\nc", 'd"')) == "a.'b\\nc'.'d\"'"
    assert place_text(("agents", "agent_1", "start", 0)) == "agents.agent_1.start[0]"


BOMB = b"a: &a [x, x]\n" + b"".join(
    b"%c: &%c [*%c, *%c]\n" % (97 + n, 97 + n, 96 + n, 96 + n) for n in range(1, 20)
)


@pytest.mark.parametrize(
    ("content", "line", "expected"),
    [
        (b"", 1, "empty"),
        (b"# only a comment\n", 1, "empty"),
        (b"- a\n- b\n", 1, "expected a mapping"),
        (b"just text", 1, "'just text'"),
        (b"a: 1\nb: [1, 2\n", 3, "not valid YAML"),
        (b"a: 1\n\tb: 2\n", 2, "not valid YAML"),
        (b"a: 1\nb: \x00\n", 1, "not valid YAML"),
        (b"a: 1\nb: \xff\n", 2, "0xff isn't UTF-8"),
        (b"a: 1\nb: 2\na: 3\n", 3, "a: given twice; it first stands in line 1"),
        (b"a: {b: 1}\nc: {d: 1, d: 2}\n", 2, "c.d: given twice"),
        (b"a: 1\n2: b\n", 2, "2 as a key"),
        (b"a: 1\n? [b]\n: c\n", 2, "a list or mapping as a key"),
        (b"a: 1\n<<: {b: 1}\nb: *x\n", 3, "alias"),
        (BOMB, 1, "anchor 'a'"),
        (b"a: 1\nb: !!python/object/apply:os.system ['true']\n", 2, "tag"),
        (b"a: !!str 1\n", 1, "tag"),
        (b"a: 1\nb: .nan\n", 2, "finite"),
        (b"a: -.inf\n", 1, "finite"),
        (b"a: 1e999\n", 1, "finite"),
        (b"a: 1\n---\nb: 2\n", 2, "second document"),
        (b"a: " + b"[" * MAX_DEPTH + b"]" * MAX_DEPTH, 1, "nested deeper"),
        (b"a: " + b"[" * 400_000, 1, "nested deeper"),
        (b"a: " + b"x" * MAX_BYTES, 1, "bytes; expected at most"),
    ],
)
def test_what_is_refused_is_one_line_with_its_place(
    content: bytes, line: int, expected: str
) -> None:
    """Each kind of bad YAML names file and line and says what is wrong."""
    with pytest.raises(ScenarioError) as caught:
        parse_yaml(content, "bad.yaml")
    message = str(caught.value)
    assert message.startswith(f"bad.yaml:{line}: ")
    assert expected in message
    assert "\n" not in message
    assert len(message) < 200
