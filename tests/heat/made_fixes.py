"""Fixes by hand."""

from __future__ import annotations

import numpy as np

from rover_heat.thermal.fix import Fix


def fix(x: float, y: float, normal: float = 0.0, sigma: float = 0.05, **other: float) -> Fix:
    variance = sigma**2
    return Fix(
        0, 2, (3, 3), x, y, (variance, 0.0, 0.0, variance), normal,
        other.get("range", 1.0), other.get("peak", 6.0),
    )  # fmt: skip


def cloud(x: float, y: float, count: int, normal: float = 0.0, seed: int = 0) -> list[Fix]:
    rng = np.random.default_rng(seed)
    return [fix(*(rng.normal((x, y), 0.04)), normal) for _ in range(count)]
