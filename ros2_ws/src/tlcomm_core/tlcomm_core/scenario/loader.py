"""Scenario files to checked scenarios and back.

``load_scenario``  a file
``loads``          its text
``dumps``          a scenario as text, with every default filled in
``verify``         refuses a scenario that fails its checks, wherever it came from

Every failure is a ``ScenarioError`` of one line: file, line, field, what was found and what was
expected; the first in the file if there are several.
"""

import json
from collections.abc import Iterator, Mapping
from pathlib import Path
from types import UnionType
from typing import Any, Final, TypeVar, get_args

import yaml
from pydantic import BaseModel, ValidationError
from pydantic_core import ErrorDetails

from tlcomm_core.errors import ScenarioError
from tlcomm_core.scenario.automaton_file import inline_automata
from tlcomm_core.scenario.checks import check
from tlcomm_core.scenario.document import (
    MAX_BYTES,
    Document,
    Node,
    Place,
    parse_yaml,
    place_text,
)
from tlcomm_core.scenario.finding import Finding, did_you_mean
from tlcomm_core.scenario.model import ACTION_FORMS, Action, AnyAction, Scenario, Workspace
from tlcomm_core.workspace.map_image import MapDescription, read_image

__all__ = ["dumps", "load_scenario", "loads", "verify"]

_Model = TypeVar("_Model", bound=BaseModel)

_SHOWN_CHARACTERS: Final = 60
_WIDTH: Final = 100
_MAP_REPLACES: Final = ("size_m", "origin_m", "obstacles_m")


def load_scenario(path: str | Path) -> Scenario:
    """Read and check a scenario file.

    A ``workspace.map`` is read too and becomes size, origin and obstacles, also after changes; the
    file that an agent's ``automaton`` names becomes its text.

    Raises:
        ScenarioError: the file can't be read, or isn't a scenario that can be run.
    """
    return _scenario(_read(Path(path), str(path)), str(path), Path(path).parent)


def loads(text: str, name: str = "scenario", folder: str | Path = ".") -> Scenario:
    """Read and check a scenario's text.

    Args:
        text: YAML.
        name: how errors call the text.
        folder: where a ``workspace.map`` and automata are looked for.

    Raises:
        ScenarioError: the text isn't a scenario that can be run.
    """
    return _scenario(text.encode("utf-8", "surrogatepass"), name, Path(folder))


def dumps(scenario: Scenario) -> str:
    """Return YAML with every default filled in, which loads back to an equal scenario.

    It stands alone: what came from a map file is written out as obstacles, automata as text.
    """
    plain = json.loads(scenario.model_dump_json(exclude_none=True))
    text: str = yaml.dump(
        plain, Dumper=_Dumper, sort_keys=False, default_flow_style=None, width=_WIDTH
    )
    return text


class _Dumper(yaml.SafeDumper):
    """Writes texts of several lines as blocks."""

    def represent_text(self, text: str) -> yaml.ScalarNode:
        style = "|" if "\n" in text else None
        return self.represent_scalar("tag:yaml.org,2002:str", text, style)


_Dumper.add_representer(str, _Dumper.represent_text)


def verify(scenario: Scenario) -> Scenario:
    """Return the scenario itself if it passes its checks.

    Raises:
        ScenarioError: it doesn't.
    """
    for finding in check(scenario):
        raise ScenarioError(f"{scenario.name}: {place_text(finding.place)}: {finding.what}")
    return scenario


def _scenario(content: bytes, name: str, folder: Path) -> Scenario:
    document = parse_yaml(content, name)
    _inline_map(document, name, folder)
    files = inline_automata(document, name, folder)
    scenario = _validated(Scenario, document, name)
    findings = [_in_file(finding, files) for finding in check(scenario)]
    _raise_first(findings or [*_oversize(scenario)], document, name)
    return scenario


def _in_file(finding: Finding, files: Mapping[Place, Path]) -> Finding:
    """Return a finding that names the file in which it is, if that isn't the scenario's."""
    file = files.get(finding.place)
    return finding if file is None else Finding(finding.place, f"in {str(file)!r}: {finding.what}")


def _oversize(scenario: Scenario) -> Iterator[Finding]:
    """Find what other files hold and makes the scenario, written out, too large to be read."""
    sources: list[tuple[Place, str]] = [
        (("agents", name, "automaton"), "automata")
        for name, agent in scenario.agents.items()
        if agent.automaton is not None
    ]
    if scenario.workspace.changes:
        sources.append((("workspace", "changes"), "changes of the map"))
    size = len(dumps(scenario).encode()) if sources else 0
    if size > MAX_BYTES:
        place, what = sources[-1]
        what = f"with its {what} the scenario has {size} bytes; expected at most {MAX_BYTES}"
        yield Finding(place, what)


def _read(path: Path, name: str) -> bytes:
    try:
        with path.open("rb") as file:
            return file.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise ScenarioError(f"{name}: can't be read: {reason}; expected a YAML file") from error


def _inline_map(document: Document, name: str, folder: Path) -> None:
    """Replace ``workspace.map`` by what the map says."""
    workspace = document.root.get("workspace")
    if not isinstance(workspace, dict) or "map" not in workspace:
        return
    place = ("workspace", "map")
    path = workspace.pop("map")
    both = [field for field in _MAP_REPLACES if field in workspace]
    if both:
        what = f"given beside {both[0]!r}; expected one or the other"
        _raise_first([Finding(place, what)], document, name)
    if not isinstance(path, str):
        what = f"found {_shown(path)}; expected the path of a map's YAML"
        _raise_first([Finding(place, what)], document, name)
        return
    fields = _map_fields(folder / path)
    _add_to_changes(workspace, fields["obstacles_m"])
    workspace.update(fields)
    for field in _MAP_REPLACES:
        document.lines["workspace", field] = document.line_of(place)


def _add_to_changes(workspace: dict[str, Node], boxes: Node) -> None:
    """Let what the map shows stay when obstacles change."""
    changes = workspace.get("changes")
    for change in changes if isinstance(changes, list) else ():
        own = change.get("obstacles_m") if isinstance(change, dict) else None
        if isinstance(change, dict) and isinstance(own, list) and isinstance(boxes, list):
            change["obstacles_m"] = [*own, *boxes]


def _map_fields(path: Path) -> dict[str, Node]:
    document = parse_yaml(_read(path, str(path)), str(path))
    description = _validated(MapDescription, document, str(path))
    try:
        found = read_image(description, path.parent)
    except ScenarioError as error:
        field = str(error).split(":", 1)[0]
        raise ScenarioError(f"{path}:{document.line_of((field,))}: {error}") from error
    boxes: list[Node] = [list(box) for box in found.boxes()]
    return {
        "size_m": list(found.size_m),
        "origin_m": list(found.origin_m),
        "obstacles_m": boxes,
    }


def _validated(kind: type[_Model], document: Document, name: str) -> _Model:
    try:
        # From JSON, because strict validation takes lists as tuples only there.
        return kind.model_validate_json(json.dumps(document.root))
    except ValidationError as error:
        findings = [_finding(details, kind) for details in error.errors(include_url=False)]
    _raise_first(findings, document, name)
    raise AssertionError(name)


def _raise_first(findings: list[Finding], document: Document, name: str) -> None:
    """Raise the finding that comes first in the file, if there is any."""
    if not findings:
        return
    # A misspelt field also makes the right one missing; the spelling is what helps.
    first = min(
        findings, key=lambda found: (document.line_of(found.place), "missing" in found.what)
    )
    line = document.line_of(first.place)
    raise ScenarioError(f"{name}:{line}: {place_text(first.place)}: {first.what}")


def _finding(details: ErrorDetails, kind: type[BaseModel]) -> Finding:
    """Return a validation error in the words of this project."""
    place: Place = tuple(part for part in details["loc"] if part not in ACTION_FORMS)
    found = _shown(details["input"])
    if place[-1:] == ("[key]",):
        what = f"{found} is no name; expected a letter, then letters, digits and single underscores"
        return Finding(place[:-1], what)
    match details["type"]:
        case "missing":
            return Finding(place, "missing; expected a value")
        case "extra_forbidden":
            known = _fields(kind, place[:-1])
            return Finding(place, f"unknown field; {did_you_mean(str(place[-1]), known)}")
        case "too_long" | "too_short":
            limits = details.get("ctx", {})
            bound = limits.get("max_length", limits.get("min_length"))
            side = "most" if details["type"] == "too_long" else "least"
            return Finding(place, f"found {found}; expected at {side} {bound} items")
        case "model_type" | "dict_type":
            return Finding(place, f"found {found}; expected a mapping")
        case _:
            message = details["msg"].replace("Input should be", "expected")
            return Finding(place, f"found {found}; {message[0].lower()}{message[1:]}")


def _fields(root: type[BaseModel], place: Place) -> frozenset[str]:
    """Return the fields of the section at a place."""
    section: Any = root
    for part in place:
        is_model = isinstance(section, type) and issubclass(section, BaseModel)
        # Between sections there are only mappings from names to sections.
        # A tuple's items are all alike: tuple[Change, ...].
        inner = [kind for kind in get_args(section) if kind is not Ellipsis]
        section = section.model_fields[part].annotation if is_model else inner[-1]
        if section == AnyAction:
            section = Action
        if isinstance(section, UnionType):
            section, _ = get_args(section)  # or None
    named = frozenset(section.model_fields)
    return named | {"map"} if section is Workspace else named


def _shown(value: Any) -> str:  # noqa: ANN401
    text = repr(value)
    return text if len(text) <= _SHOWN_CHARACTERS else f"{text[:_SHOWN_CHARACTERS]}…"
