"""Maps read as Nav2's map_server reads them."""

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from tlcomm_core.errors import ScenarioError
from tlcomm_core.workspace.grid import Grid
from tlcomm_core.workspace.map_image import MAX_PIXELS, MapDescription, read_image

FREE, UNKNOWN, OCCUPIED = 254, 205, 0


def describe(image: str, **changes: object) -> MapDescription:
    """A map of the image with some fields changed."""
    fields: dict[str, object] = {
        "image": image,
        "resolution": 0.1,
        "origin": [-1.0, 2.0, 0.0],
        "negate": 0,
        "occupied_thresh": 0.65,
        "free_thresh": 0.196,
    }
    return MapDescription.model_validate(fields | changes)


def write_image(path: Path, rows: list[list[int]], mode: str = "L") -> str:
    """Write grey values; return the file's name."""
    Image.fromarray(np.array(rows, dtype=np.uint8), "L").convert(mode).save(path)
    return path.name


@pytest.mark.parametrize("suffix", ["pgm", "png"])
def test_occupied_and_unknown_pixels_are_closed(tmp_path: Path, suffix: str) -> None:
    """The first image row is the top; unknown counts as closed."""
    rows = [[FREE, OCCUPIED], [FREE, FREE], [UNKNOWN, FREE]]
    image = write_image(tmp_path / f"map.{suffix}", rows)
    found = read_image(describe(image), tmp_path)
    assert found.closed.tolist() == [[True, False], [False, False], [False, True]]
    assert found.origin_m == (-1.0, 2.0)
    assert found.size_m == pytest.approx((0.2, 0.3))


def test_negate_swaps_dark_and_light(tmp_path: Path) -> None:
    """With negate, dark is free."""
    image = write_image(tmp_path / "map.pgm", [[0, 255]])
    assert read_image(describe(image, negate=1), tmp_path).closed.tolist() == [[False, True]]


def test_colour_is_averaged_and_transparency_is_unknown(tmp_path: Path) -> None:
    """White is free, transparent white isn't."""
    pixels = np.full((1, 2, 4), 255, dtype=np.uint8)
    pixels[0, 1, 3] = 0
    Image.fromarray(pixels, "RGBA").save(tmp_path / "map.png")
    assert read_image(describe("map.png"), tmp_path).closed.tolist() == [[False, True]]


def test_boxes_cover_exactly_the_closed_pixels(tmp_path: Path) -> None:
    """Random pixels as boxes close the same cells, at the pixels' own resolution."""
    rng = np.random.default_rng(1)
    rows = np.where(rng.random((20, 30)) < 0.4, OCCUPIED, FREE)
    found = read_image(describe(write_image(tmp_path / "map.pgm", rows.tolist())), tmp_path)
    boxes = found.boxes()
    assert len(boxes) < np.count_nonzero(found.closed)
    assert (Grid(found.size_m, 0.1, boxes, found.origin_m).free == ~found.closed).all()


def test_a_solid_block_is_one_box(tmp_path: Path) -> None:
    """Equal runs above each other merge."""
    rows = [[FREE] * 4, [FREE, OCCUPIED, OCCUPIED, FREE], [FREE, OCCUPIED, OCCUPIED, FREE]]
    found = read_image(describe(write_image(tmp_path / "map.pgm", rows)), tmp_path)
    assert found.boxes() == [(-0.9, 2.0, -0.7, 2.2)]


def test_a_cell_with_any_closed_pixel_is_closed(tmp_path: Path) -> None:
    """A coarser grid closes a cell for one pixel."""
    rows = [[FREE] * 10 for _ in range(5)]
    rows[2][7] = OCCUPIED
    found = read_image(describe(write_image(tmp_path / "map.pgm", rows)), tmp_path)
    grid = Grid(found.size_m, 0.5, found.boxes(), found.origin_m)
    assert grid.free.tolist() == [[True, False]]


@pytest.mark.parametrize(
    ("name", "content", "expected"),
    [
        ("missing.pgm", None, "No such file"),
        ("../map.pgm", None, "isn't beside"),
        ("/etc/map.pgm", None, "isn't beside"),
        (".", None, "isn't beside"),
        ("map.pgm", b"hello", "isn't an image"),
        ("map.pgm", b"P5 10 10 255\n...", "can't be read"),
        ("map.pgm", b"P5 50000 50000 255\n...", "too large"),
        ("map.pgm", b"P5 5000 5000 255\n...", f"expected <= {MAX_PIXELS}"),
        ("map.pgm", b"P5 1 1 65535\n\0\0", "expected 8-bit"),
    ],
)
def test_a_bad_image_is_one_clear_line(
    tmp_path: Path, name: str, content: bytes | None, expected: str
) -> None:
    """Missing, outside, damaged and oversized images each say so and name the file."""
    if content is not None:
        (tmp_path / name).write_bytes(content)
    with pytest.raises(ScenarioError, match=expected) as caught:
        read_image(describe(name), tmp_path)
    assert repr(name) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_turned_map_is_refused(tmp_path: Path) -> None:
    """Only yaw 0 is supported."""
    image = write_image(tmp_path / "map.pgm", [[FREE]])
    with pytest.raises(ScenarioError, match="yaw"):
        read_image(describe(image, origin=[0.0, 0.0, 0.1]), tmp_path)
