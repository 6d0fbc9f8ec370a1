"""A comparison's folder: what is done stays, and the same command goes on with the rest.

``Archive``  its files
"""

import json
import shutil
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final, Self

from tlcomm_core.errors import InputError
from tlcomm_tools.comparison.job import AUDIT, TRACE, Job
from tlcomm_tools.figures.trace import Trace
from tlcomm_tools.folder import dumps_json, replace_file, unused_folder

__all__ = ["Archive"]

_MOST_SHOWN: Final = 40


@dataclass(frozen=True, slots=True)
class Archive:
    """The folder that holds a comparison, a folder per run in it.

    Attributes:
        path: of the folder.
    """

    path: Path

    @classmethod
    def open(cls, name: str, out: Path | None, terms: Mapping[str, Any]) -> Self:
        """Make the folder, or find it as an earlier command left it.

        Args:
            name: of the scenario.
            out: the folder; by default a new one below ``runs/``.
            terms: what all of its runs have in common.

        Raises:
            InputError: the folder can't be made, or holds something else.
        """
        path = unused_folder(Path("runs"), f"{name}-compare") if out is None else out
        archive = cls(path)
        try:
            path.mkdir(parents=True, exist_ok=True)
            if archive._terms.exists():
                archive._expect(terms)
            elif any(path.iterdir()):
                raise InputError(f"--out: {str(path)!r} isn't empty and holds no comparison")
            else:
                archive.write("terms.json", dumps_json(terms))
        except OSError as error:
            raise InputError(f"can't make the folder {str(path)!r}: {error.strerror}") from error
        return archive

    def folder(self, job: Job) -> Path:
        """Return a job's folder."""
        return self.path / job.folder

    def has(self, job: Job) -> bool:
        """Tell whether a job is done.

        Raises:
            InputError: its folder holds a run of another scenario.
        """
        folder = self.folder(job)
        if not folder.exists():
            return False
        scenario = folder / "scenario.yaml"
        if not scenario.is_file() or scenario.read_text("utf-8") != job.scenario:
            raise InputError(
                f"--out: {str(folder)!r} holds another scenario's run; expected another folder"
            )
        return True

    def staging(self, job: Job) -> Path:
        """Return the path at which a job's files are put together; nothing is left there."""
        path = self._part(job)
        shutil.rmtree(path, ignore_errors=True)
        path.parent.mkdir(parents=True, exist_ok=True)
        return path

    def keep(self, job: Job, files: Mapping[str, str]) -> None:
        """Write a job's files, all or none of them."""
        staging = self.staging(job)
        staging.mkdir()
        for name, text in files.items():
            replace_file(staging / name, text)
        self.adopt(job)

    def adopt(self, job: Job) -> None:
        """Take what was put together for a job as its files."""
        self._part(job).rename(self.folder(job))

    def result(self, job: Job) -> dict[str, Any]:
        """Return the result document of a job that is done.

        Raises:
            InputError: it can't be read.
        """
        return self._document(job, "result.json")

    def audit(self, job: Job) -> dict[str, Any]:
        """Return what the audit found of a job that is done.

        Raises:
            InputError: it can't be read.
        """
        return self._document(job, AUDIT)

    def traces(self, jobs: Iterable[Job]) -> list[Trace]:
        """Return what figures are drawn from, of those jobs that are done and to be drawn.

        Raises:
            InputError: such a file can't be read.
        """
        paths = [self.folder(job) / TRACE for job in jobs if job.is_drawn]
        return [Trace.from_json(path.read_text("utf-8")) for path in paths]

    def write(self, name: str, text: str) -> None:
        """Write a file of the whole comparison."""
        replace_file(self.path / name, text)

    def _document(self, job: Job, name: str) -> dict[str, Any]:
        path = self.folder(job) / name
        try:
            document: dict[str, Any] = json.loads(path.read_text("utf-8"))
        except (OSError, ValueError) as error:
            raise InputError(
                f"{str(path)!r} can't be read ({error}); remove its folder to run it again"
            ) from error
        return document

    def _part(self, job: Job) -> Path:
        folder = self.folder(job)
        return folder.with_name(f".{folder.name}.part")

    @property
    def figures(self) -> Path:
        """The folder of the figures."""
        path = self.path / "figures"
        path.mkdir(exist_ok=True)
        return path

    @property
    def _terms(self) -> Path:
        return self.path / "terms.json"

    def _expect(self, terms: Mapping[str, Any]) -> None:
        """Refuse runs that can't be compared with those that are there."""
        try:
            found: dict[str, Any] = json.loads(self._terms.read_text("utf-8"))
        except ValueError as error:
            raise InputError(f"--out: {str(self._terms)!r} can't be read: {error}") from error
        for name, value in terms.items():
            if found.get(name) != value:
                raise InputError(
                    f"--out: {str(self.path)!r} holds a comparison with"
                    f" {_difference(name, found.get(name), value)}; expected the same command or"
                    " another folder"
                )


def _difference(name: str, found: object, wanted: object) -> str:
    if name == "scenario":
        return "another scenario"
    return f"{name} {_short(found)}, not {_short(wanted)}"


def _short(value: object) -> str:
    text = json.dumps(value)
    return text if len(text) <= _MOST_SHOWN else f"{text[:_MOST_SHOWN]}…"
