"""Pictures and maps as bytes for a browser."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np

from rover_common.types import GridMap

MARGIN = 3  # [cells] of unknown ground shown around what is known
UNKNOWN = 255  # in a map's picture; otherwise the probability of an obstacle [%]


@dataclass(frozen=True)
class Picture:
    """An image of a topic."""

    stamp: int  # [ns]
    image: np.ndarray  # (height, width, 3) uint8 RGB


@dataclass(frozen=True)
class Jpeg:
    """An image of a topic that is compressed already."""

    stamp: int  # [ns]
    data: bytes  # of the file


@dataclass(frozen=True)
class StampedMap:
    """A map of a topic."""

    stamp: int  # [ns]
    grid: GridMap


@dataclass(frozen=True)
class Encoded:
    """What goes over the wire: facts for a header, and bytes."""

    facts: dict[str, Any]
    content: bytes


def picture_of(picture: Picture | Jpeg) -> Encoded:
    """A JPEG as it is; an image as PNG, which suits the few colours of a segmented one."""
    if isinstance(picture, Jpeg):
        return Encoded({"type": "image/jpeg", "stamp": picture.stamp * 1e-9}, picture.data)
    bgr = cv2.cvtColor(picture.image, cv2.COLOR_RGB2BGR)
    _, data = cv2.imencode(".png", bgr, [cv2.IMWRITE_PNG_COMPRESSION, 1])
    return Encoded({"type": "image/png", "stamp": picture.stamp * 1e-9}, data.tobytes())


def map_of(stamped: StampedMap) -> Encoded | None:
    """The part of a map that is known, as a grey picture with north at its top.

    The facts place the picture in the map frame: its south-west corner, its size and that of a cell
    [m]. None when nothing is known.
    """
    grid = stamped.grid
    known = grid.cells >= 0
    rows, columns = np.flatnonzero(known.any(axis=1)), np.flatnonzero(known.any(axis=0))
    if not len(rows):
        return None
    top, left = max(0, rows[0] - MARGIN), max(0, columns[0] - MARGIN)
    cells = grid.cells[top : rows[-1] + MARGIN + 1, left : columns[-1] + MARGIN + 1]
    grey = np.where(cells < 0, UNKNOWN, cells).astype(np.uint8)
    _, data = cv2.imencode(".png", np.flipud(grey))
    cell_area = grid.resolution**2
    facts = {
        "type": "image/png",
        "stamp": stamped.stamp * 1e-9,
        "x": grid.origin_x + float(left) * grid.resolution,
        "y": grid.origin_y + float(top) * grid.resolution,
        "width": cells.shape[1] * grid.resolution,
        "height": cells.shape[0] * grid.resolution,
        "resolution": grid.resolution,
        "ground": round(float(np.count_nonzero(known & (grid.cells < 50))) * cell_area, 1),
    }
    return Encoded(facts, data.tobytes())
