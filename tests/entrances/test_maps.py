"""A map of any size, cell and content that passes its check can be planned on."""

from __future__ import annotations

from typing import Any

import numpy as np
from cases import CASES, fuzzed
from hypothesis import given
from hypothesis import strategies as st
from maps import costmap, plan

from rover_common.geometry import Pose
from rover_common.types import GridMap
from rover_navigation.hazards import Hazards

CELLS = st.sampled_from([-1, 0, 0, 0, 0, 30, 49, 50, 51, 100])
PLACES = st.floats(-40.0, 40.0)


@st.composite
def grids(draw: Any) -> GridMap:
    """Of any shape, odd ones and single cells among them; cells in blocks or one by one."""
    rows, cols = draw(st.integers(1, 40)), draw(st.integers(1, 40))
    block = draw(st.sampled_from([1, 4, 11]))
    few = draw(st.lists(CELLS, min_size=4, max_size=16))
    index = np.arange(rows)[:, None] // block * 7 + np.arange(cols)[None, :] // block
    cells = np.array(few, np.int8)[index % len(few)]
    size = draw(st.sampled_from([0.05, 0.25, 0.3, 1.0, 3.7]))
    return GridMap(size, draw(PLACES), draw(PLACES), cells)


@fuzzed(CASES * 0.05)
@given(grids(), PLACES, PLACES)
def test_a_plan_is_made_on_every_map(grid, x, y):
    made = costmap(grid, body=(x, y))
    assert made.geometry.rows % 2 == made.geometry.cols % 2 == 0
    plan(grid, pose=Pose(x, y, 0.0))


@fuzzed(CASES * 0.05)
@given(grids(), grids())
def test_hazards_are_drawn_into_every_map(hazards, grid):
    places = Hazards()
    places.set(hazards, grid)
    assert places.drawn_into(grid).cells.shape == grid.cells.shape
