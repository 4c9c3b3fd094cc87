"""The true map of a world, as a picture."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

from rover_common.errors import RoverError
from rover_common.grid import GridGeometry

CELLS = GridGeometry.of_world(1.0)
ADVICE = "save it as PNG with two values and without transparency"
# Its values are probabilities, and its first row is the north.
MAP_SERVER_VALUES = {0, 205, 254}


class TruthError(RoverError, ValueError):
    """The ground truth cannot be read."""


def load_truth(path: Path) -> NDArray[np.bool_]:
    """Ground truth (200, 200): pixel [y, x] of the file, unflipped; the brighter is navigable.

    A picture has two values, in any depth. One with more, as a JPEG has, is not thresholded: what
    it means is not known. Raises TruthError when there is no file, or no such picture in it.
    """
    pixels = _pixels(path)
    rows, cols = pixels.shape[:2]
    values = np.unique(pixels.reshape(rows * cols, -1), axis=0).astype(int)
    brightness = values.sum(axis=1)
    if len(values) == 1:
        raise TruthError(f"{path}: no navigable cell: all pixels are {_in_words(values[0])}")
    if len(values) > 2 or brightness[0] == brightness[1]:
        raise TruthError(f"{path}: {_values_in_words(values)}, not two; {ADVICE}")
    navigable = pixels.reshape(rows, cols, -1) == values[np.argmax(brightness)]
    return np.asarray(navigable.all(axis=2))


def _pixels(path: Path) -> NDArray[np.integer]:
    """Grey values (200, 200) or colours (200, 200, 3)."""
    try:
        with Image.open(path) as image:
            if image.size != (CELLS.cols, CELLS.rows):
                size = f"{image.width} x {image.height}"
                raise TruthError(f"{path}: {size} pixels, expected {CELLS.cols} x {CELLS.rows}")
            pixels = np.asarray(_opaque(path, image))
    except UnidentifiedImageError as error:
        raise TruthError(f"{path}: not an image") from error
    except (OSError, SyntaxError, ValueError, Image.DecompressionBombError) as error:
        if isinstance(error, TruthError):
            raise
        reason = getattr(error, "strerror", None) or error
        raise TruthError(f"{path}: {reason}") from error
    return pixels.astype(np.uint8) if pixels.dtype == bool else pixels


def _opaque(path: Path, image: Image.Image) -> Image.Image:
    """In grey or in colours; raises TruthError for a picture that is transparent somewhere."""
    if image.has_transparency_data and np.asarray(image.convert("RGBA"))[..., 3].min() < 255:
        raise TruthError(f"{path}: some of its pixels are transparent; {ADVICE}")
    grey = image.mode in ("1", "L") or image.mode.startswith("I")
    return image if grey else image.convert("RGB")


def _values_in_words(values: NDArray[np.int_]) -> str:
    if set(values.ravel().tolist()) == MAP_SERVER_VALUES:
        return "the values of a map of map_server (0, 205, 254)"
    return f"{len(values)} values"


def _in_words(value: NDArray[np.int_]) -> str:
    return ", ".join(map(str, value))
