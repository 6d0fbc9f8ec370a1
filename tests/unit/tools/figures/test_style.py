"""Tests of ``tlcomm_tools.figures.style``."""

from pathlib import Path
from xml.etree import ElementTree as ET

import matplotlib as mpl
import pytest
from PIL import Image

from tlcomm_core.method import Method
from tlcomm_tools.figures.style import (
    agent_labels,
    agent_line,
    method_line,
    new_figure,
    save,
    show_large_numbers,
    styled,
)


def draw(folder: Path) -> tuple[Path, Path]:
    """Write a small figure."""
    folder.mkdir()
    with styled():
        figure = new_figure(2.0, 1.0)
        axes = figure.add_subplot()
        axes.plot([0.0, 1.0], "o--")
        axes.fill_between([0.0, 1.0], [0.0, 1.0], hatch="//")
        axes.set_xlabel("time (s)")
        return save(figure, folder, "small")


def test_every_method_looks_different_without_colour() -> None:
    """No two share dashes or markers."""
    lines = [method_line(method) for method in Method]
    assert len({line.dashes for line in lines}) == len(lines)
    assert len({line.marker for line in lines}) == len(lines)
    assert len({line.colour for line in lines}) == len(lines)


def test_eight_agents_look_different() -> None:
    """The ninth looks like the first."""
    assert len({agent_line(index).marker for index in range(8)}) == 8
    assert agent_line(8) == agent_line(0)


@pytest.mark.parametrize(
    ("names", "labels"),
    [
        (("agent_1", "agent_12"), ("1", "12")),
        (("left_1", "right_1"), ("left_1", "right_1")),
        (("agent_1", "chief"), ("agent_1", "chief")),
    ],
)
def test_agents_are_called_by_number_where_it_is_clear(
    names: tuple[str, ...], labels: tuple[str, ...]
) -> None:
    """Otherwise by name."""
    assert agent_labels(names) == dict(zip(names, labels, strict=True))


def test_the_same_figure_makes_the_same_files(tmp_path: Path) -> None:
    """No date, no random ids."""
    one, other = draw(tmp_path / "one"), draw(tmp_path / "other")
    assert [path.read_bytes() for path in one] == [path.read_bytes() for path in other]


def test_files_are_what_their_names_say(tmp_path: Path) -> None:
    """An SVG that parses, and a PNG sharp enough for print."""
    vector, raster = draw(tmp_path / "out")
    root = ET.parse(vector).getroot()  # noqa: S314 - our own file
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    with Image.open(raster) as image:
        assert (image.format, image.size) == ("PNG", (440, 220))


def test_the_users_style_counts_outside_only() -> None:
    """It neither shows in figures nor is it changed."""
    with mpl.rc_context({"font.size": 30.0, "axes.facecolor": "red"}):
        with styled():
            assert mpl.rcParams["font.size"] == 8.0
            assert mpl.rcParams["axes.facecolor"] == "white"
        assert mpl.rcParams["font.size"] == 30.0
        assert mpl.rcParams["axes.facecolor"] == "red"


@pytest.mark.parametrize(("highest", "text"), [(9_000.0, "5000"), (90_000.0, "50k")])
def test_large_numbers_are_short(highest: float, text: str) -> None:
    """From ten thousand on."""
    axes = new_figure(2.0, 1.0).add_subplot()
    axes.set_ylim(0.0, highest)
    show_large_numbers(axes.yaxis)
    number = float(text.replace("k", "000"))
    assert axes.yaxis.get_major_formatter().format_ticks([number]) == [text]
