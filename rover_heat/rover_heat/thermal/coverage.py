"""Which faces of walls were seen by a thermal sensor so that heat on them would have shown."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_common.geometry import wrap_angle
from rover_common.grid import GridGeometry
from rover_heat.config import HeatConfig, thermal_yaw
from rover_heat.thermal.detection import AZIMUTHS, PIXEL
from rover_heat.thermal.fix import View

CELL = 0.05  # [m]
REACH = 1.5  # [m] a source there shows in 98 of 100 frames, up to 45 degrees off the normal
OBLIQUE = math.radians(45.0)  # off a face's normal
# A patch at the border of the image gives no fix, so the outer columns examine nothing.
FIELD = float(AZIMUTHS[0]) - PIXEL / 2  # [rad] to either side of a sensor's axis
SECTORS = 32  # of directions that a cell was seen from
BEFORE = 0.03  # [m] from the lidar's point to the cell before the wall that it stands for
HALF = 1 << 20  # cells: keys of cells are positive
# from a cell's key to that of itself and of the eight around it
STEPS = np.array([row * (1 << 32) + col for row in (-1, 0, 1) for col in (-1, 0, 1)])

Points = NDArray[np.float64]
Keys = NDArray[np.int64]


@dataclass(frozen=True)
class Examined:
    """Cells before walls, and from which directions each was seen; a snapshot."""

    keys: Keys  # (n,)
    sectors: NDArray[np.uint32]  # (n,) bits

    def raster(self, geometry: GridGeometry) -> NDArray[np.uint32]:
        """(rows, cols) The bits of each cell of a grid, with those of the cells around it."""
        bits = np.zeros((geometry.rows + 2, geometry.cols + 2), np.uint32)
        x, y = _centers(self.keys)
        row, col = geometry.cell_of(x, y)
        inside = geometry.contains(row, col)
        np.bitwise_or.at(bits, (row[inside] + 1, col[inside] + 1), self.sectors[inside])
        wide = bits[:, :-2] | bits[:, 1:-1] | bits[:, 2:]
        return wide[:-2] | wide[1:-1] | wide[2:]


NOTHING = Examined(np.empty(0, np.int64), np.empty(0, np.uint32))


class Coverage:
    """Marks what two frames of one sensor in a row have seen."""

    def __init__(self, config: HeatConfig) -> None:
        self._config = config
        self._sectors: dict[int, int] = {}  # by key of the cell
        self._before: dict[int, tuple[int, Keys]] = {}  # by sensor: number of its frame, keys

    def update(self, view: View, number: int) -> None:
        """A frame that is fit for a fix; `number` counts all frames of its sensor."""
        origin = np.array([view.pose.x, view.pose.y])
        towards = origin - view.hits
        ranges = np.hypot(*towards.T)
        axis = view.pose.yaw + thermal_yaw(self._config, view.sensor)
        aside = np.arctan2(-towards[:, 1], -towards[:, 0]) - axis
        aside = np.abs((aside + math.pi) % (2.0 * math.pi) - math.pi)
        seen = (ranges <= REACH) & (ranges > BEFORE) & (aside <= FIELD)
        towards = towards[seen] / ranges[seen, None]
        keys = _keys(view.hits[seen] + BEFORE * towards)
        sectors = sector_of(np.arctan2(towards[:, 1], towards[:, 0]))
        before = self._before.get(view.sensor)
        self._before[view.sensor] = (number, np.unique(keys))
        if before is None or before[0] != number - 1:
            return
        twice = np.isin(keys, _grown(before[1]))
        for key, sector in zip(keys[twice].tolist(), sectors[twice].tolist(), strict=True):
            self._sectors[key] = self._sectors.get(key, 0) | 1 << sector

    def examined_from(self, x: float, y: float, faces: Points) -> float:
        """Share of some faces (n, 2) [m] that were examined from about the direction of a place."""
        towards = np.array([x, y]) - faces
        sectors = sector_of(np.arctan2(towards[:, 1], towards[:, 0])).tolist()
        around = [self._around(key) for key in _keys(faces).tolist()]
        seen = [bits & _beside(sector) for bits, sector in zip(around, sectors, strict=True)]
        return sum(map(bool, seen)) / len(seen) if seen else 1.0

    def _around(self, key: int) -> int:
        """The bits of a cell and of the eight around it."""
        bits = 0
        for step in STEPS.tolist():
            bits |= self._sectors.get(key + step, 0)
        return bits

    def give_up(self, faces: Points) -> None:
        """Faces (n, 2) [m] that could not be examined: they are no goals any more."""
        for key in _keys(faces).tolist():
            self._sectors[key] = (1 << SECTORS) - 1

    def restore(self, examined: Examined) -> None:
        """Take a snapshot; raises ValueError for what is none."""
        pairs = zip(examined.keys.tolist(), examined.sectors.tolist(), strict=True)
        self._sectors = dict(pairs)

    def snapshot(self) -> Examined:
        """A copy that stays as it is."""
        if not self._sectors:
            return NOTHING
        keys = np.fromiter(self._sectors.keys(), np.int64, len(self._sectors))
        return Examined(keys, np.fromiter(self._sectors.values(), np.uint32, len(keys)))


def sector_of(direction: NDArray[np.float64]) -> NDArray[np.int64]:
    """Number of the sector that a direction [rad] lies in."""
    return np.floor(direction / (2.0 * math.pi) * SECTORS + 0.5).astype(np.int64) % SECTORS


def sectors_around(normal: float) -> int:
    """Bits of the directions from which a face with this normal [rad] is seen well enough."""
    bits, width = 0, 2.0 * math.pi / SECTORS
    for sector in range(SECTORS):  # all of a sector counts, or none
        if abs(wrap_angle(width * sector - normal)) <= OBLIQUE - width / 2:
            bits |= 1 << sector
    return bits


def _keys(points: Points) -> Keys:
    cells = np.floor(points / CELL).astype(np.int64) + HALF
    return np.asarray(cells[:, 1] << 32 | cells[:, 0])


def _centers(keys: Keys) -> tuple[Points, Points]:
    cols, rows = (keys & 0xFFFFFFFF) - HALF, (keys >> 32) - HALF
    return np.asarray((cols + 0.5) * CELL), np.asarray((rows + 0.5) * CELL)


def _grown(keys: Keys) -> Keys:
    """These cells and the eight around each."""
    return np.unique(keys[:, None] + STEPS)


def _beside(sector: int) -> int:
    """Bits of a sector and of its neighbours."""
    return sum(1 << (sector + step) % SECTORS for step in (-1, 0, 1))
