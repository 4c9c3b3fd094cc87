"""Grids, the joining of stamped parts, and parameters that are declared once."""

from dataclasses import dataclass

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from rclpy.exceptions import InvalidParameterValueException
from rclpy.node import Node

from rover_common.config import parameter
from rover_common.grid import GridGeometry
from rover_common.ros.parameters import ParameterError, declare_parameters
from rover_common.ros.sync import ExactTimeSynchronizer


@given(st.integers(0, 399), st.integers(0, 399))
def test_a_cells_centre_lies_in_the_cell(row, col):
    grid = GridGeometry.of_world(0.5)
    x, y = grid.center_of(row, col)
    assert grid.cell_of(x, y) == (row, col)
    assert grid.contains(row, col)


def test_points_outside_are_outside():
    grid = GridGeometry.of_world(1.0)
    row, col = grid.cell_of([-0.1, 200.1, 5.0], [5.0, 5.0, -3.0])
    assert not grid.contains(row, col).any()


def test_row_follows_y_and_column_follows_x():
    row, col = GridGeometry.of_world(1.0).cell_of(3.5, 7.5)
    assert (int(row), int(col)) == (7, 3)


def test_join_waits_for_all_parts():
    join = ExactTimeSynchronizer(("a", "b"))
    assert join.add("a", 1, "A") is None
    assert join.add("b", 2, "other") is None
    assert join.add("b", 1, "B") == {"a": "A", "b": "B"}
    with pytest.raises(KeyError):
        join.add("c", 1, "C")


def test_join_forgets_the_oldest():
    join = ExactTimeSynchronizer(("a", "b"), pending=2)
    for stamp in range(5):
        join.add("a", stamp, stamp)
    assert join.dropped == 3
    assert join.add("b", 0, 0) is None
    assert join.add("b", 4, 4) == {"a": 4, "b": 4}


@dataclass(frozen=True)
class Config:
    speed: float = parameter(1.0, "[m/s] speed", minimum=0.0, maximum=5.0)
    count: int = parameter(3, "how many", minimum=1, maximum=9)
    kind: str = parameter("red", "colour", choices=("red", "blue"))


def test_parameters_come_from_the_dataclass(ros):
    node = ros.add(lambda **kwargs: Node("n", **kwargs), speed=2.5)
    config = declare_parameters(node, Config)
    assert config == Config(speed=2.5)
    descriptor = node.describe_parameter("speed")
    assert descriptor.description == "[m/s] speed"
    assert descriptor.floating_point_range[0].to_value == 5.0
    assert descriptor.read_only


@pytest.mark.parametrize(
    ("values", "error"),
    [({"speed": 9.0}, InvalidParameterValueException), ({"kind": "green"}, ParameterError)],
)
def test_a_parameter_out_of_range_is_refused(ros, values, error):
    node = ros.add(lambda **kwargs: Node("n", **kwargs), **values)
    with pytest.raises(error):
        declare_parameters(node, Config)


def test_grid_arrays_have_one_entry_per_point():
    row, col = GridGeometry.of_world(1.0).cell_of(np.zeros(4), np.zeros(4))
    assert row.shape == col.shape == (4,)
