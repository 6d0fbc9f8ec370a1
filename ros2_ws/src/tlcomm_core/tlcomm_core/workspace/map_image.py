"""Maps as Nav2's map_server reads them: a YAML description beside an image.

``MapDescription``  the YAML's fields
``OccupancyMap``    which pixels are closed, and where they lie
``read_image``      description and image file to an occupancy map
"""

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Final, Literal

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError
from pydantic import BaseModel, ConfigDict, Field, FiniteFloat

from tlcomm_core.errors import ScenarioError
from tlcomm_core.workspace.grid import Box

__all__ = ["MAX_PIXELS", "MapDescription", "OccupancyMap", "read_image"]

MAX_PIXELS: Final = 16_000_000
_OPAQUE: Final = 255
# Nanometres: multiples of a resolution such as 0.05 read as what they mean.
_DECIMALS: Final = 9
_MODES: Final = ("1", "L", "LA", "P", "RGB", "RGBA")
_Share = Annotated[FiniteFloat, Field(ge=0.0, le=1.0)]


class MapDescription(BaseModel):
    """A map_server YAML, trinary mode only: unknown space counts as closed.

    Deviates: the map may not be turned (the origin's yaw is 0) and the image lies beside the YAML.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    image: str
    resolution: Annotated[FiniteFloat, Field(gt=0.0)]
    origin: Annotated[list[FiniteFloat], Field(min_length=3, max_length=3)]
    negate: bool | Literal[0, 1] = False
    occupied_thresh: _Share = 0.65
    free_thresh: _Share = 0.25
    mode: Literal["trinary"] = "trinary"


@dataclass(frozen=True, slots=True)
class OccupancyMap:
    """Closed pixels over a rectangle.

    Attributes:
        closed: bool[rows, columns], the first row at the bottom.
        resolution_m: edge length of a pixel.
        origin_m: lower left corner (x, y).
    """

    closed: NDArray[np.bool_]
    resolution_m: float
    origin_m: tuple[float, float]

    @property
    def size_m(self) -> tuple[float, float]:
        """Extent along x and y."""
        rows, columns = self.closed.shape
        return columns * self.resolution_m, rows * self.resolution_m

    def boxes(self) -> list[Box]:
        """Return the closed pixels as rectangles, by their upper edge.

        Equal runs of pixels in rows above each other make one rectangle.
        Cost: O(pixels) in numpy, O(runs) in Python.
        """
        rectangles: list[tuple[int, int, int, int]] = []
        open_since: dict[tuple[int, int], int] = {}
        for row in range(len(self.closed) + 1):
            runs = _runs(self.closed[row]) if row < len(self.closed) else ()
            kept = {run: open_since.get(run, row) for run in runs}
            rectangles += [
                (first, since, end, row)
                for (first, end), since in open_since.items()
                if (first, end) not in kept
            ]
            open_since = kept
        return [self._box(rectangle) for rectangle in rectangles]

    def _box(self, rectangle: tuple[int, int, int, int]) -> Box:
        first, low, end, high = rectangle
        x_m, y_m = self.origin_m
        return (
            round(x_m + first * self.resolution_m, _DECIMALS),
            round(y_m + low * self.resolution_m, _DECIMALS),
            round(x_m + end * self.resolution_m, _DECIMALS),
            round(y_m + high * self.resolution_m, _DECIMALS),
        )


def read_image(description: MapDescription, folder: Path) -> OccupancyMap:
    """Read the image of a map.

    Args:
        description: what the YAML says.
        folder: where the YAML lies.

    Raises:
        ScenarioError: the image isn't a file in the folder, or isn't a PNG or PGM of at most
            ``MAX_PIXELS`` pixels, or the map is turned.

    Deviates: a pixel that isn't fully opaque is unknown.
    Cost: O(pixels).
    """
    if description.origin[2] != 0.0:
        raise ScenarioError(f"origin: {description.origin!r} turns the map; expected a yaw of 0.0")
    pixels = _pixels(_beside(description.image, folder), description.image)
    shade = pixels[..., :3].mean(axis=2) / 255.0
    occupied = shade if description.negate else 1.0 - shade
    is_free = (occupied < description.free_thresh) & (occupied <= description.occupied_thresh)
    is_free &= pixels[..., 3] == _OPAQUE
    closed = np.flipud(~is_free)
    closed.setflags(write=False)
    origin_m = (description.origin[0], description.origin[1])
    return OccupancyMap(closed, description.resolution, origin_m)


def _beside(image: str, folder: Path) -> Path:
    """Return the image's path, which must not leave the folder."""
    path = (folder / image).resolve()
    if Path(image).is_absolute() or folder.resolve() not in path.parents:
        raise ScenarioError(
            f"image: {image!r} isn't beside the map's YAML; expected a file in its folder"
        )
    return path


def _pixels(path: Path, name: str) -> NDArray[np.uint8]:
    """Return an image as uint8[rows, columns, 4], the first row at the top."""
    try:
        with Image.open(path, formats=("PNG", "PPM")) as image:
            columns, rows = image.size
            if columns * rows > MAX_PIXELS:
                raise ScenarioError(
                    f"image: {name!r} has {columns * rows} pixels; expected <= {MAX_PIXELS}"
                )
            if image.mode not in _MODES:
                raise ScenarioError(
                    f"image: {name!r} has pixels of kind {image.mode!r}; expected 8-bit ones"
                )
            return np.asarray(image.convert("RGBA"))
    except (Image.DecompressionBombError, Image.DecompressionBombWarning) as error:
        raise ScenarioError(
            f"image: {name!r} is far too large; expected at most {MAX_PIXELS} pixels"
        ) from error
    except UnidentifiedImageError as error:
        raise ScenarioError(f"image: {name!r} isn't an image; expected PNG or PGM") from error
    except (OSError, SyntaxError, ValueError) as error:
        reason = getattr(error, "strerror", None) or "damaged"
        raise ScenarioError(
            f"image: {name!r} can't be read ({reason}); expected PNG or PGM"
        ) from error


def _runs(row: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return the runs of True as (first, end)."""
    edges = np.flatnonzero(np.diff(row.astype(np.int8), prepend=0, append=0))
    return [(int(first), int(end)) for first, end in edges.reshape(-1, 2)]
