"""Parameters are declared once, as fields of a dataclass."""

from dataclasses import dataclass

import pytest
from rclpy.node import Node
from rclpy.parameter import Parameter

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
    ("values", "text"),
    [
        ({"speed": 9.0}, r"speed has to be a number from 0.0 to 5.0"),
        ({"count": 80000}, r"count has to be an integer from 1 to 9"),
        ({"count": "abc"}, r"count has to be an integer from 1 to 9"),
        ({"kind": 5}, r"kind has to be a text"),
        ({"kind": "green"}, r"kind: 'green' is not one of red, blue"),
    ],
)
def test_a_parameter_that_cannot_be_used_is_refused_in_one_sentence(ros, values, text):
    node = ros.add(lambda **kwargs: Node("n", **kwargs), **values)
    with pytest.raises(ParameterError, match=text):
        declare_parameters(node, Config)


@dataclass(frozen=True)
class Settable:
    speed: float = parameter(1.0, "[m/s] speed", minimum=0.0, maximum=5.0, settable=True)
    kind: str = parameter("red", "colour", choices=("red", "blue"), settable=True)
    count: int = parameter(3, "how many", minimum=1, maximum=9)


@pytest.fixture
def changes(ros):
    """A node with settable parameters, and the configurations that it was given."""
    node, given = ros.add(lambda **kwargs: Node("n", **kwargs)), []
    declare_parameters(node, Settable, given.append)
    return node, given


def test_a_settable_parameter_changes_the_configuration(changes):
    node, given = changes
    (result,) = node.set_parameters([Parameter("speed", value=2.5)])
    assert result.successful
    node.set_parameters_atomically([Parameter("speed", value=3.0), Parameter("kind", value="blue")])
    assert given == [Settable(speed=2.5), Settable(speed=3.0, kind="blue")]


@pytest.mark.parametrize(
    ("name", "value"),
    [("speed", 5.5), ("speed", float("nan")), ("speed", "fast"), ("kind", "green"), ("count", 4)],
)
def test_a_value_that_cannot_be_is_refused_before_it_takes_effect(changes, name, value):
    node, given = changes
    (result,) = node.set_parameters([Parameter(name, value=value)])
    assert not result.successful
    assert result.reason
    assert given == []
    assert node.get_parameter(name).value == getattr(Settable(), name)


def test_without_a_listener_nothing_is_settable(ros):
    node = ros.add(lambda **kwargs: Node("n", **kwargs))
    declare_parameters(node, Settable)
    (result,) = node.set_parameters([Parameter("speed", value=2.5)])
    assert not result.successful


def test_an_integer_is_taken_for_a_float_at_the_start_and_later(ros):
    node, given = ros.add(lambda **kwargs: Node("n", **kwargs), speed=2), []
    config = declare_parameters(node, Settable, given.append)
    assert (config.speed, type(config.speed)) == (2.0, float)
    (result,) = node.set_parameters([Parameter("speed", value=4)])
    assert result.successful, result.reason
    assert given == [Settable(speed=4.0)]
    (result,) = node.set_parameters([Parameter("speed", value=6)])
    assert not result.successful
    assert node.get_parameter("speed").value == 4.0
