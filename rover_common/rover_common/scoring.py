"""How a map and rock positions are scored against the truth."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import cv2
import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment
from scipy.spatial.distance import cdist

FREE_BELOW = 50  # a published cell of 0..49 counts as navigable
ROCK_RADIUS = 1.0  # [m] a located rock lies this near to a true sample


class TruthError(ValueError):
    """The ground truth cannot be read."""


@dataclass(frozen=True)
class MapScore:
    """All in percent."""

    percent_mapped: float  # true navigable cells that the map has, of all true navigable cells
    fidelity: float  # mapped navigable cells that are truly navigable, of all mapped ones
    f1: float  # harmonic mean of the two


@dataclass(frozen=True)
class RockScore:
    located: int  # true samples with a found rock within ROCK_RADIUS
    missed: int
    false: int  # found rocks that belong to no true sample


def load_truth(path: Path) -> NDArray[np.bool_]:
    """Ground truth (200, 200): pixel [y, x] of the file, unflipped, non-zero = navigable.

    Raises TruthError when the file is no image of that size.
    """
    image = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)
    if image is None:
        raise TruthError(f"{path}: not an image")
    if image.shape != (200, 200):
        raise TruthError(f"{path}: {image.shape[1]} x {image.shape[0]} pixels, expected 200 x 200")
    if not image.any():
        raise TruthError(f"{path}: no navigable cell")
    return image > 0


def navigable_cells(cells: NDArray[np.int8]) -> NDArray[np.bool_]:
    """Cells of an OccupancyGrid that count as mapped navigable."""
    return (cells >= 0) & (cells < FREE_BELOW)


def score_map(navigable: NDArray[np.bool_], truth: NDArray[np.bool_]) -> MapScore:
    """Score mapped navigable cells against the truth, both (200, 200)."""
    right = int(np.count_nonzero(navigable & truth))
    mapped = 100.0 * right / int(np.count_nonzero(truth))
    fidelity = 100.0 * right / max(1, int(np.count_nonzero(navigable)))
    f1 = 2.0 * mapped * fidelity / (mapped + fidelity) if right else 0.0
    return MapScore(mapped, fidelity, f1)


def score_rocks(found: NDArray[np.float64], true: NDArray[np.float64]) -> RockScore:
    """Match found rocks (n, 2) [m] one to one with true samples (m, 2) [m]."""
    if len(found) == 0 or len(true) == 0:
        return RockScore(0, len(true), len(found))
    distance = cdist(found, true)
    # As many pairs within reach as there can be: one out of reach costs more than all the others.
    pairs = linear_sum_assignment(np.where(distance <= ROCK_RADIUS, distance, 1e6))
    located = int(np.count_nonzero(distance[pairs] <= ROCK_RADIUS))
    return RockScore(located, len(true) - located, len(found) - located)
