"""Calls the services of simulation_interfaces, as `ros2 service call` does."""

from __future__ import annotations

import math
from typing import Any

from rclpy.node import Node
from simulation_interfaces.msg import SimulationState
from simulation_interfaces.srv import (
    GetSimulationState,
    GetSimulatorFeatures,
    ResetSimulation,
    SetEntityState,
    SetSimulationState,
    StepSimulation,
)

PLAYING, PAUSED = SimulationState.STATE_PLAYING, SimulationState.STATE_PAUSED
STOPPED = SimulationState.STATE_STOPPED


class Person:
    """Asks one simulator; each call returns the service's result."""

    def __init__(self, ros: Any) -> None:
        self._ros = ros
        self.node: Node = ros.add(lambda **kwargs: Node("person", **kwargs))

    def call(self, kind: Any, name: str, request: Any) -> Any:
        client = self.node.create_client(kind, name)
        assert self._ros.spin_until(client.service_is_ready), name
        future = client.call_async(request)
        assert self._ros.spin_until(future.done), name
        return future.result()

    def features(self) -> list[int]:
        request = GetSimulatorFeatures.Request()
        answer = self.call(GetSimulatorFeatures, "get_simulator_features", request)
        return list(answer.features.features)

    def state(self) -> int:
        request = GetSimulationState.Request()
        return int(self.call(GetSimulationState, "get_simulation_state", request).state.state)

    def set_state(self, state: int) -> Any:
        request = SetSimulationState.Request(state=SimulationState(state=state))
        return self.call(SetSimulationState, "set_simulation_state", request).result

    def step(self, count: int) -> Any:
        return self.call(
            StepSimulation, "step_simulation", StepSimulation.Request(steps=count)
        ).result

    def reset(self, scope: int = 0) -> Any:
        request = ResetSimulation.Request(scope=scope)
        return self.call(ResetSimulation, "reset_simulation", request).result

    def place(self, x: float, y: float, yaw: float, entity: str = "", frame: str = "") -> Any:
        request = SetEntityState.Request(entity=entity)
        request.state.header.frame_id = frame
        request.state.pose.position.x, request.state.pose.position.y = x, y
        request.state.pose.orientation.z = math.sin(yaw / 2)
        request.state.pose.orientation.w = math.cos(yaw / 2)
        return self.call(SetEntityState, "set_entity_state", request).result
