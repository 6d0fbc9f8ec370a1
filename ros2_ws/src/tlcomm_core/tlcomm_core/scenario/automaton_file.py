"""Automata that a scenario names by their files.

``inline_automata``  replaces the files' names by their texts
"""

from pathlib import Path
from typing import Final

from tlcomm_core.errors import ScenarioError
from tlcomm_core.scenario.document import MAX_BYTES, Document, Place, place_text

__all__ = ["inline_automata"]

_BEGIN: Final = "HOA:"
_SHOWN_CHARACTERS: Final = 200


def inline_automata(document: Document, name: str, folder: Path) -> dict[Place, Path]:
    """Replace each path that stands for an agent's automaton by the text of the file.

    What begins with ``HOA:`` is a text already.

    Args:
        document: changed in place.
        name: how errors call it.
        folder: where paths begin.

    Returns:
        The file of each place that was changed.

    Raises:
        ScenarioError: a file can't be read, is too large, or doesn't begin with ``HOA:``.
    """
    files: dict[Place, Path] = {}
    agents = document.root.get("agents")
    for agent, fields in agents.items() if isinstance(agents, dict) else ():
        value = fields.get("automaton") if isinstance(fields, dict) else None
        if not isinstance(fields, dict) or not isinstance(value, str) or value.startswith(_BEGIN):
            continue
        place = ("agents", agent, "automaton")
        files[place] = folder / value
        try:
            fields["automaton"] = _read(files[place])
        except ScenarioError as error:
            where = f"{name}:{document.line_of(place)}: {place_text(place)}"
            raise ScenarioError(f"{where}: {error}") from error
    return files


def _read(path: Path) -> str:
    """Return the text of a file, its lines without blanks at their ends."""
    shown = repr(str(path)[:_SHOWN_CHARACTERS])
    try:
        with path.open("rb") as file:
            content = file.read(MAX_BYTES + 1)
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise ScenarioError(
            f"{shown} can't be read: {reason}; expected a file in HOA v1, or its text"
        ) from error
    if len(content) > MAX_BYTES:
        raise ScenarioError(f"{shown} has more than {MAX_BYTES} bytes")
    try:
        text = content.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        line = content.count(b"\n", 0, error.start) + 1
        raise ScenarioError(
            f"in {shown}: line {line}: byte {content[error.start]:#04x} isn't UTF-8 text"
        ) from error
    if not text.startswith(_BEGIN):
        begin = text.split("\n", 1)[0][:_SHOWN_CHARACTERS]
        raise ScenarioError(f"in {shown}: line 1: found {begin!r}; expected {_BEGIN!r} first")
    return "".join(f"{line.rstrip()}\n" for line in text.splitlines())
