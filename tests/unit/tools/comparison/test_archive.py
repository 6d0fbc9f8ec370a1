"""A comparison's folder."""

from pathlib import Path

import pytest

from tlcomm_core.errors import InputError
from tlcomm_core.method import Method
from tlcomm_tools.comparison.archive import Archive
from tlcomm_tools.comparison.job import Job

TERMS = {"scenario": "name: hall\n", "rounds": 5, "until_s": None}
FILES = {"scenario.yaml": "name: hall\n", "result.json": '{"verdict": "ok"}'}


def job(folder: str = "team-0", scenario: str = "name: hall\n") -> Job:
    """Return a job."""
    return Job(folder, scenario, Method.TEAM, "coalition", 0, 10.0, 1.0)


def test_what_is_kept_is_there_when_the_folder_is_opened_again(tmp_path: Path) -> None:
    """And nothing else is."""
    archive = Archive.open("hall", tmp_path / "out", TERMS)
    assert not archive.has(job())
    archive.keep(job(), FILES)
    archive.keep(job("range-1/team-0"), FILES)
    again = Archive.open("hall", tmp_path / "out", TERMS)
    assert again.has(job())
    assert again.has(job("range-1/team-0"))
    assert not again.has(job("team-1"))
    assert again.result(job()) == {"verdict": "ok"}


def test_a_run_that_was_cut_off_isnt_there(tmp_path: Path) -> None:
    """Files appear together under their name, and what was left behind is no hindrance."""
    archive = Archive.open("hall", tmp_path / "out", TERMS)
    staging = archive.staging(job())
    staging.mkdir()
    (staging / "result.json").write_text("{", "utf-8")
    assert not archive.has(job())
    archive.keep(job(), FILES)
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == ["team-0", "terms.json"]
    assert archive.result(job()) == {"verdict": "ok"}


@pytest.mark.parametrize(
    ("terms", "complaint"),
    [
        ({**TERMS, "rounds": 6}, "rounds 5, not 6"),
        ({**TERMS, "until_s": 60.0}, "until_s null, not 60.0"),
        ({**TERMS, "scenario": "name: shed\n"}, "another scenario"),
    ],
)
def test_other_terms_are_refused(tmp_path: Path, terms: dict[str, object], complaint: str) -> None:
    """With what is different."""
    Archive.open("hall", tmp_path / "out", TERMS)
    with pytest.raises(InputError, match=complaint):
        Archive.open("hall", tmp_path / "out", terms)


def test_a_folder_that_holds_something_else_is_refused(tmp_path: Path) -> None:
    """It isn't written to."""
    (tmp_path / "file").touch()
    with pytest.raises(InputError, match="isn't empty and holds no comparison"):
        Archive.open("hall", tmp_path, TERMS)
    with pytest.raises(InputError, match="can't make the folder"):
        Archive.open("hall", tmp_path / "file", TERMS)
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_a_run_of_another_scenario_in_its_place_is_refused(tmp_path: Path) -> None:
    """Results must not be mixed."""
    archive = Archive.open("hall", tmp_path, TERMS)
    archive.keep(job(), {**FILES, "scenario.yaml": "name: shed\n"})
    with pytest.raises(InputError, match="another scenario's run"):
        archive.has(job())


def test_a_damaged_result_is_named(tmp_path: Path) -> None:
    """With what to do."""
    archive = Archive.open("hall", tmp_path, TERMS)
    archive.keep(job(), {**FILES, "result.json": "{"})
    with pytest.raises(InputError, match=r"team-0/result\.json.*remove its folder"):
        archive.result(job())
    with pytest.raises(InputError, match=r"team-0/audit\.json.*remove its folder"):
        archive.audit(job())
