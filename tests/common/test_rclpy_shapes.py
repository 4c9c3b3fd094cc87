"""The parts of rclpy that are private or overridden, and that the nodes rely on."""

from __future__ import annotations

import inspect

import pytest
from rclpy import _rclpy_pybind11
from rclpy.action import ActionServer
from rclpy.action.server import ServerGoalHandle
from rclpy.exceptions import ParameterException
from rclpy.executors import SingleThreadedExecutor
from rclpy.node import Node
from rclpy.parameter import Parameter

from rover_common.ros.actions import DeferringActionServer


def parameters(function: object) -> list[str]:
    return list(inspect.signature(function).parameters)


@pytest.mark.parametrize("name", ["RCLError", "RCLInvalidROSArgsError", "UnknownROSArgsError"])
def test_the_errors_of_a_start_are_where_they_are_caught(name):
    error = getattr(_rclpy_pybind11, name)
    assert issubclass(error, Exception)
    assert not issubclass(error, ParameterException)


def test_a_node_keeps_its_parameters_by_name(ros):
    node = ros.add(lambda **options: Node("shape", **options), given=1)
    node.declare_parameter("declared", 2)
    assert {name: p.value for name, p in node._parameter_overrides.items()} == {"given": 1}
    assert isinstance(node._parameters["declared"], Parameter)


def test_a_goal_is_executed_by_the_method_that_is_overridden():
    expected = ["self", "goal_handle", "execute_callback"]
    assert parameters(ActionServer.notify_execute) == expected
    assert parameters(DeferringActionServer.notify_execute) == expected
    source = inspect.getsource(ServerGoalHandle.execute)
    assert source.index("GoalEvent.EXECUTE") < source.index("self._action_server.notify_execute(")


def test_the_result_that_an_execution_returns_is_sent():
    """`answer` passes a callback that returns the result at once."""
    source = inspect.getsource(ActionServer.notify_execute)
    assert "self._execute_goal" in source
    execution = inspect.getsource(ActionServer._execute_goal)
    assert "await_or_execute(execute_callback, goal_handle)" in execution
    assert "set_result(" in execution


def test_an_executor_can_be_spun_for_a_time():
    wanted = ["self", "future", "timeout_sec"]
    assert parameters(SingleThreadedExecutor.spin_until_future_complete) == wanted
