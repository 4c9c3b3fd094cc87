"""The true map of a world, as a picture."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray

from rover_common.errors import RoverError
from rover_common.grid import GridGeometry

CELLS = GridGeometry.of_world(1.0)


class TruthError(RoverError, ValueError):
    """The ground truth cannot be read."""


def load_truth(path: Path) -> NDArray[np.bool_]:
    """Ground truth (200, 200): pixel [y, x] of the file, unflipped, non-zero = navigable.

    Raises TruthError when there is no file, or no image of that size in it.
    """
    try:
        content = np.fromfile(path, np.uint8)
    except OSError as error:  # cv2.imread would print a warning of its own
        raise TruthError(f"{path}: {error.strerror or error}") from error
    image = cv2.imdecode(content, cv2.IMREAD_GRAYSCALE) if content.size else None
    if image is None:
        raise TruthError(f"{path}: not an image")
    rows, cols = image.shape
    if (rows, cols) != (CELLS.rows, CELLS.cols):
        raise TruthError(f"{path}: {cols} x {rows} pixels, expected {CELLS.cols} x {CELLS.rows}")
    if not image.any():
        raise TruthError(f"{path}: no navigable cell")
    return image > 0
