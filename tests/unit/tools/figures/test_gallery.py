"""Tests of ``tlcomm_tools.figures.gallery``."""

from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from PIL import Image

from tlcomm_tools.figures.gallery import draw_comparison, draw_run, draw_sweep
from tlcomm_tools.figures.measured import MAIN
from tlcomm_tools.figures.trace import Trace


def found(*values: float | None) -> dict[str, Any]:
    """Return a comparison's document with one measure."""
    return {
        "sweep": {"name": "range"},
        "measures": {MAIN[0]: {"label": "wait (s)", "digits": 2}},
        "points": [
            {
                "value": value,
                "means": {
                    method: {MAIN[0]: {"mean": mean, "low": mean - 1.0, "high": mean + 1.0}}
                    for method, mean in (("team", 3.0), ("static", 5.0))
                },
            }
            for value in values
        ],
    }


def check(paths: tuple[Path, ...], names: set[str]) -> None:
    """Check that all figures are there, as good files of less than 1 MB."""
    assert {path.name for path in paths} == {
        f"{name}.{kind}" for name in names for kind in ("svg", "png")
    }
    for path in paths:
        assert 2_000 < path.stat().st_size < 1_000_000
        if path.suffix == ".svg":
            assert ET.parse(path).getroot().tag.endswith("svg")  # noqa: S314 - our own file
        else:
            with Image.open(path) as image:
                image.verify()


def test_a_run_has_its_figures(trace: Trace, tmp_path: Path) -> None:
    """All of one that met."""
    paths = draw_run(trace, tmp_path)
    check(paths, {"workspace", "schedule", "topologies", "meeting_places", "cost"})


def test_what_a_run_does_not_have_is_not_drawn(trace: Trace, tmp_path: Path) -> None:
    """Of agents that never met, where they worked and when."""
    lone = trace.model_copy(update={"method": "none", "meetings": (), "courses": ()})
    check(draw_run(lone, tmp_path), {"workspace", "schedule"})


def test_a_comparison_has_its_figures(trace: Trace, tmp_path: Path) -> None:
    """Measures if there are any."""
    traces = [trace, trace.model_copy(update={"method": "static"})]
    check(draw_comparison(traces, tmp_path), {"additional_time", "estimates"})
    check(
        draw_comparison(traces, tmp_path, found(None)), {"additional_time", "estimates", "metrics"}
    )


def test_methods_are_in_one_order(trace: Trace, tmp_path: Path) -> None:
    """In whichever order their runs come."""
    traces = [trace, trace.model_copy(update={"method": "static"})]
    before = [path.read_bytes() for path in draw_comparison(traces, tmp_path)]
    assert [path.read_bytes() for path in draw_comparison(traces[::-1], tmp_path)] == before


def test_a_comparison_of_nothing_draws_nothing(trace: Trace, tmp_path: Path) -> None:
    """Where nobody met and nothing was measured, or measured."""
    lone = trace.model_copy(update={"additional_times": (), "estimates": {}})
    assert draw_comparison([lone], tmp_path, found()) == ()
    assert draw_sweep(found(), tmp_path, "R") == ()


def test_a_sweep_has_its_figure(tmp_path: Path) -> None:
    """Named after what is varied."""
    check(draw_sweep(found(1.0, 1.5), tmp_path, "radio range R (m)"), {"sweep_range"})


def test_the_same_run_is_drawn_the_same(trace: Trace, tmp_path: Path) -> None:
    """Byte for byte."""
    folders = [tmp_path / "one", tmp_path / "other"]
    for folder in folders:
        folder.mkdir()
    one, other = (draw_run(trace, folder) for folder in folders)
    assert [path.read_bytes() for path in one] == [path.read_bytes() for path in other]


def test_a_folder_that_is_missing_is_an_error(trace: Trace, tmp_path: Path) -> None:
    """The error names the file."""
    with pytest.raises(FileNotFoundError, match="nowhere"):
        draw_run(trace, tmp_path / "nowhere")
