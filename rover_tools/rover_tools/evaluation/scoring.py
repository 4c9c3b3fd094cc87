"""How a map and found places are scored against the truth."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linear_sum_assignment
from scipy.spatial.distance import cdist

ROCK_RADIUS = 1.0  # [m] a located rock lies this near to a true sample


@dataclass(frozen=True)
class MapScore:
    """All in percent."""

    percent_mapped: float  # true navigable cells that the map has, of all true navigable cells
    fidelity: float  # mapped navigable cells that are truly navigable, of all mapped ones
    f1: float  # harmonic mean of the two


@dataclass(frozen=True)
class PlaceScore:
    located: int  # true places with a found one within the radius
    missed: int
    false: int  # found places that belong to no true one


def score_map(navigable: NDArray[np.bool_], truth: NDArray[np.bool_]) -> MapScore:
    """Score mapped navigable cells against the truth, both (200, 200)."""
    right = int(np.count_nonzero(navigable & truth))
    mapped = 100.0 * right / int(np.count_nonzero(truth))
    fidelity = 100.0 * right / max(1, int(np.count_nonzero(navigable)))
    f1 = 2.0 * mapped * fidelity / (mapped + fidelity) if right else 0.0
    return MapScore(mapped, fidelity, f1)


def score_places(
    found: NDArray[np.float64], true: NDArray[np.float64], radius: float = ROCK_RADIUS
) -> PlaceScore:
    """Match found places (n, 2) [m] one to one with true ones (m, 2) [m]; radius [m]."""
    if len(found) == 0 or len(true) == 0:
        return PlaceScore(0, len(true), len(found))
    distance = cdist(found, true)
    # As many pairs within reach as there can be: one out of reach costs more than all the others.
    pairs = linear_sum_assignment(np.where(distance <= radius, distance, 1e6))
    located = int(np.count_nonzero(distance[pairs] <= radius))
    return PlaceScore(located, len(true) - located, len(found) - located)
