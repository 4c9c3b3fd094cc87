"""Parameters are declared once, as fields of a dataclass."""

from dataclasses import dataclass

import pytest
from rclpy.exceptions import InvalidParameterValueException
from rclpy.node import Node

from rover_common.config import parameter
from rover_common.ros.parameters import ParameterError, declare_parameters


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
