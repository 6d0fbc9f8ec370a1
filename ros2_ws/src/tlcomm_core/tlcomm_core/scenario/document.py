"""YAML text as plain values that know their lines; everything risky in YAML is refused.

``Document``    a parsed file
``Place``       where a value stands: keys and list indices from the root
``Node``        a plain value
``parse_yaml``  text to a document
``place_text``  a place as people write it
"""

import math
import re
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Final

import yaml

from tlcomm_core.errors import ScenarioError

__all__ = ["MAX_BYTES", "MAX_DEPTH", "Document", "Node", "Place", "parse_yaml", "place_text"]

MAX_BYTES: Final = 1_000_000
MAX_DEPTH: Final = 50

Place = tuple[str | int, ...]
Node = str | int | float | bool | list["Node"] | dict[str, "Node"] | None

_Loader: Final = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
_SHOWN_CHARACTERS: Final = 60

# The core schema of YAML 1.2, not the surprises of 1.1 (`no`, `1:30`, `012`).
_CONSTANTS: Final[dict[str, bool | None]] = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL")),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
}
_INTEGER: Final = re.compile(r"[-+]?[0-9]{1,18}")
_FLOAT: Final = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
_PLAIN_KEY: Final = re.compile(r"[\w-]{1,60}")
_NOT_FINITE: Final = re.compile(r"[-+]?\.inf|\.nan", re.IGNORECASE)


@dataclass(frozen=True, slots=True)
class Document:
    """A parsed YAML file.

    Attributes:
        root: plain values all the way down.
        lines: line (from 1) of each key and list item.
    """

    root: dict[str, Node]
    lines: dict[Place, int]

    def line_of(self, place: Place) -> int:
        """Return the line of a place, or of what it would stand in if it is missing."""
        while place and place not in self.lines:
            place = place[:-1]
        return self.lines.get(place, 1)


@dataclass(slots=True)
class _Open:
    """A list or mapping that isn't closed yet; ``key`` waits for its value."""

    value: list[Node] | dict[str, Node]
    place: Place
    key: str | None = None


@dataclass(slots=True)
class _Builder:
    """Turns parser events into values; no recursion, so that depth is only a number."""

    name: str
    lines: dict[Place, int] = field(default_factory=dict)
    open: list[_Open] = field(default_factory=list)
    roots: list[Node] = field(default_factory=list)

    def take(self, event: yaml.Event) -> None:
        """Take the parser's next event."""
        match event:
            case yaml.AliasEvent():
                raise self.error(event, "found an alias; write the value out instead")
            case yaml.DocumentStartEvent() if self.roots:
                raise self.error(event, "found a second document; expected one")
            case yaml.ScalarEvent():
                self.refuse_tag(event)
                self.place_value(event, self.scalar(event))
            case yaml.SequenceStartEvent() | yaml.MappingStartEvent():
                self.refuse_tag(event)
                is_list = isinstance(event, yaml.SequenceStartEvent)
                self.descend(event, [] if is_list else {})
            case yaml.SequenceEndEvent() | yaml.MappingEndEvent():
                self.open.pop()
            case _:
                pass

    def descend(self, event: yaml.Event, value: list[Node] | dict[str, Node]) -> None:
        """Open a list or mapping where the next value goes."""
        if len(self.open) >= MAX_DEPTH:
            raise self.error(event, f"nested deeper than {MAX_DEPTH} levels")
        self.open.append(_Open(value, self.place_value(event, value)))

    def place_value(self, event: yaml.Event, value: Node) -> Place:
        """Put a value, or note a key; return the value's place."""
        if not self.open:
            self.roots.append(value)
            return ()
        parent = self.open[-1]
        if isinstance(parent.value, list):
            place = (*parent.place, len(parent.value))
            parent.value.append(value)
            self.lines[place] = _line(event)
            return place
        if parent.key is None:
            parent.key = self.new_key(event, parent, value)
            return parent.place
        place = (*parent.place, parent.key)
        parent.value[parent.key] = value
        parent.key = None
        return place

    def new_key(self, event: yaml.Event, parent: _Open, key: Node) -> str:
        """Return a mapping's next key, which must be text and new to it."""
        assert isinstance(parent.value, dict)
        if not isinstance(key, str):
            found = "a list or mapping" if isinstance(key, list | dict) else repr(key)
            where = place_text(parent.place) or "the file"
            raise self.error(event, f"{where}: found {found} as a key; expected text")
        place = (*parent.place, key)
        if key in parent.value:
            before = self.lines[place]
            raise self.error(
                event, f"{place_text(place)}: given twice; it first stands in line {before}"
            )
        self.lines[place] = _line(event)
        return key

    def refuse_tag(
        self, event: yaml.ScalarEvent | yaml.SequenceStartEvent | yaml.MappingStartEvent
    ) -> None:
        """Refuse what makes YAML more than plain values."""
        if event.anchor is not None:
            raise self.error(event, f"anchor {event.anchor!r}; write the value out instead")
        if event.tag is not None:
            raise self.error(event, f"tag {event.tag!r}; expected plain values only")

    def next_place(self) -> Place:
        """Return where the next value goes."""
        if not self.open:
            return ()
        parent = self.open[-1]
        index = len(parent.value) if isinstance(parent.value, list) else parent.key
        return parent.place if index is None else (*parent.place, index)

    def scalar(self, event: yaml.ScalarEvent) -> Node:
        """Return the value of a scalar; quoted ones are text."""
        text: str = event.value
        is_plain, _ = event.implicit
        if not is_plain:
            return text
        if text in _CONSTANTS:
            return _CONSTANTS[text]
        if _INTEGER.fullmatch(text):
            return int(text)
        if _NOT_FINITE.fullmatch(text) or (_FLOAT.fullmatch(text) and math.isinf(float(text))):
            what = f"found {_shown(text)}; expected a finite number"
            raise self.error(event, f"{place_text(self.next_place())}: {what}")
        return float(text) if _FLOAT.fullmatch(text) else text

    def error(self, event: yaml.Event, what: str) -> ScenarioError:
        """Return an error with the line of an event."""
        return ScenarioError(f"{self.name}:{_line(event)}: {what}")


def parse_yaml(content: bytes, name: str) -> Document:
    """Parse one YAML document whose root is a mapping.

    Args:
        content: the file's bytes, UTF-8, at most ``MAX_BYTES``.
        name: how errors call the file.

    Raises:
        ScenarioError: not YAML, or it holds anything but text, finite numbers, true, false, null,
            lists and mappings with distinct text keys; anchors and aliases are refused too.
    """
    builder = _Builder(name)
    text = _decoded(content, name)
    try:
        for event in _events(text):
            builder.take(event)
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        line = 1 if mark is None else mark.line + 1
        raise ScenarioError(
            f"{name}:{line}: not valid YAML: {error.problem or error.context}"
        ) from error
    except yaml.YAMLError as error:
        reason = " ".join(str(error).split())
        raise ScenarioError(f"{name}:1: not valid YAML: {reason}") from error
    root = builder.roots[0] if builder.roots else None
    if root is None:
        raise ScenarioError(f"{name}:1: the file is empty; expected a mapping of fields")
    if not isinstance(root, dict):
        raise ScenarioError(f"{name}:1: found {_shown(root)}; expected a mapping of fields")
    return Document(root, builder.lines)


def place_text(place: Place) -> str:
    """Return a place as people write it: ``agents.agent_1.start[0]``."""
    parts = (f"[{part}]" if isinstance(part, int) else f".{_key_text(part)}" for part in place)
    return "".join(parts).removeprefix(".")


def _key_text(key: str) -> str:
    return key if _PLAIN_KEY.fullmatch(key) else _shown(key)


def _events(text: str) -> Iterator[yaml.Event]:
    events: Iterator[yaml.Event] = yaml.parse(text, Loader=_Loader)
    return events


def _decoded(content: bytes, name: str) -> str:
    if len(content) > MAX_BYTES:
        raise ScenarioError(f"{name}:1: {len(content)} bytes; expected at most {MAX_BYTES}")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise ScenarioError(
            f"{name}:{line}: byte {content[error.start]:#04x} isn't UTF-8 text"
        ) from error


def _line(event: yaml.Event) -> int:
    assert event.start_mark is not None, "events that come from a text have a place in it"
    return event.start_mark.line + 1


def _shown(value: Node) -> str:
    text = repr(value)
    return text if len(text) <= _SHOWN_CHARACTERS else f"{text[:_SHOWN_CHARACTERS]}…"
