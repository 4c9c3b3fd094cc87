"""The costmap: what is free, and how much clearance there is."""

import numpy as np
from maps import HALL, SCALE, UNKNOWN, costmap, opened

from rover_common.map_encoding import EDGE
from rover_common.types import GridMap
from rover_navigation.types import BlockedPlace


def clearances(map_: GridMap, x: float) -> tuple[float, float]:
    """[m] to obstacles, and to edges as well, on the hall's middle line."""
    made = costmap(map_)
    cell = made.geometry.cell_of(x, 20.0)
    return float(made.clearance[cell]), float(made.edge_clearance[cell])


def test_the_hidden_side_of_an_obstacle_has_no_clearance():
    boulder = opened(HALL, 30, 19.75, 30.5, 20.25, 100)
    shadow = opened(boulder, 30.5, 19.75, 32.5, 20.25)
    assert clearances(shadow, 31.25) == (0.0, 0.0)  # within a metre: it may be the boulder
    assert min(clearances(shadow, 32.25)) > 0.5
    assert min(clearances(boulder, 31.25)) > 0.5


def test_an_edge_beside_an_obstacle_can_be_driven_with_care():
    boulder = opened(HALL, 30, 19.75, 30.5, 20.25, 100)
    clearance, care = clearances(opened(boulder, 30.5, 19.75, 32.5, 20.25, EDGE), 31.25)
    assert clearance > 0.5
    assert care == 0.0


def test_an_obstacle_beside_the_trail_stays_on_the_map():
    beside = opened(HALL, 30, 20.5, 31, 21.5, 100)
    trail = np.array([(x, 20.0) for x in np.arange(12, 38, 0.5)])
    made = costmap(beside, trail, body=(37.0, 20.0))
    assert not made.free[made.geometry.cell_of(30.5, 20.6)]
    assert made.free[made.geometry.cell_of(30.5, 20.1)]


def test_a_blocked_place_is_an_obstacle_also_where_nothing_is_known():
    for x in (20.0, 40.5, 45.0):  # in the hall, in its wall, beyond it
        made = costmap(HALL, blocked=(BlockedPlace(x, 20.0, 0.5),), body=(x - 2.0, 20.0))
        cell = made.geometry.cell_of(x, 20.0)
        assert not made.free[cell]
        assert not made.unknown[cell]


def test_it_covers_what_is_known_and_the_robot():
    made = costmap(HALL, body=(55.0, 55.0))
    for x, y in ((10.5, 15.5), (39.5, 24.5), (55.0, 55.0)):
        assert made.geometry.contains(*made.geometry.cell_of(x, y))
    assert made.geometry.rows % 2 == made.geometry.cols % 2 == 0
    alone = costmap(UNKNOWN, body=(0.1, 59.9))  # in the map's corner, where nothing is known
    assert alone.free[alone.geometry.cell_of(0.1, 59.9)]


def test_a_trail_clears_whole_discs_wherever_it_goes():
    trail = np.array([(30.0, 20.0), (0.1, 0.1), (-0.6, 30.0), (59.9, 59.9), (300.0, -50.0)])
    made = costmap(UNKNOWN, trail, body=(30.0, 30.0))
    x, y = made.geometry.center_of(*np.indices(made.free.shape))
    away = np.hypot(x - trail[:, :1, None], y - trail[:, 1:2, None]).min(axis=0)
    assert made.free[away < SCALE.trail_radius - 0.1].all()
    near = np.hypot(x - 30.0, y - 30.0) < SCALE.blind_radius + 0.5
    assert not made.free[(away > SCALE.trail_radius + 0.4) & ~near].any()
