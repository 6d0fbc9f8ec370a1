"""A run's folder.

``RunFolder``      its files
``dumps_json``     a document as a file's text
``unused_folder``  a new path below another, marked by the time
``replace_file``   writes a file whole or not at all
"""

import json
import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Self

from tlcomm_core.errors import InputError
from tlcomm_core.records import RunRecords, event_log

__all__ = ["RunFolder", "dumps_json", "replace_file", "unused_folder"]


@dataclass(frozen=True, slots=True)
class RunFolder:
    """The folder that holds all a run leaves behind.

    Attributes:
        path: of the folder.
    """

    path: Path

    @classmethod
    def create(cls, name: str, method: str, out: Path | None) -> Self:
        """Make the folder: ``out``, or a new one below ``runs/``.

        Raises:
            InputError: ``out`` holds something already, or can't be made.
        """
        path = unused_folder(Path("runs"), f"{name}-{method}") if out is None else out
        try:
            path.mkdir(parents=True, exist_ok=True)
            if any(path.iterdir()):
                raise InputError(f"--out: {str(path)!r} isn't empty")
        except OSError as error:
            raise InputError(f"can't make the folder {str(path)!r}: {error.strerror}") from error
        return cls(path)

    @property
    def scenario(self) -> Path:
        """The scenario with every default filled in."""
        return self.path / "scenario.yaml"

    @property
    def bag(self) -> Path:
        """The bag's folder."""
        return self.path / "bag"

    @property
    def logs(self) -> Path:
        """The folder of the processes' logs."""
        return self.path / "logs"

    @property
    def result(self) -> Path:
        """The results."""
        return self.path / "result.json"

    @property
    def events(self) -> Path:
        """The event log."""
        return self.path / "events.jsonl"

    def write_scenario(self, text: str) -> None:
        """Write the scenario."""
        replace_file(self.scenario, text)

    def write_results(self, result: Mapping[str, Any], records: RunRecords) -> None:
        """Write results and event log."""
        replace_file(self.events, "".join(f"{line}\n" for line in event_log(records)))
        replace_file(self.result, dumps_json(result))


def dumps_json(document: Mapping[str, Any]) -> str:
    """Return a document as a file's text."""
    return json.dumps(document, indent=2, ensure_ascii=False) + "\n"


def unused_folder(folder: Path, name: str) -> Path:
    """Return a path that doesn't exist, marked by the local time."""
    stem = f"{name}-{time.strftime('%Y%m%d-%H%M%S')}"
    path, number = folder / stem, 1
    while path.exists():
        number += 1
        path = folder / f"{stem}-{number}"
    return path


def replace_file(path: Path, text: str) -> None:
    """Write a file whole or not at all.

    Raises:
        OSError: it can't be written; the error names it.
    """
    temporary = path.with_name(f".{path.name}.tmp")
    try:
        temporary.write_text(text, "utf-8")
        temporary.replace(path)
    except OSError as error:
        # A write, unlike an opening, doesn't say to which file.
        raise OSError(error.errno, error.strerror, str(path)) from error
    finally:
        temporary.unlink(missing_ok=True)
