"""What people ask of a simulator, by the services of the package simulation_interfaces.

get_simulator_features, get_simulation_state, set_simulation_state, reset_simulation,
step_simulation and set_entity_state, relative to the node's namespace.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Protocol

from rclpy.node import Node
from simulation_interfaces.msg import Result, SimulationState, SimulatorFeatures
from simulation_interfaces.srv import (
    GetSimulationState,
    GetSimulatorFeatures,
    ResetSimulation,
    SetEntityState,
    SetSimulationState,
    StepSimulation,
)

from rover_common.errors import RoverError
from rover_common.geometry import Pose, angles_from_quaternion

FEATURES = (
    SimulatorFeatures.SIMULATION_RESET,
    SimulatorFeatures.SIMULATION_RESET_STATE,
    SimulatorFeatures.SIMULATION_STATE_GETTING,
    SimulatorFeatures.SIMULATION_STATE_SETTING,
    SimulatorFeatures.SIMULATION_STATE_PAUSE,
    SimulatorFeatures.STEP_SIMULATION_SINGLE,
    SimulatorFeatures.STEP_SIMULATION_MULTIPLE,
    SimulatorFeatures.ENTITY_STATE_SETTING,
)
WHOLE = (ResetSimulation.Request.SCOPE_DEFAULT, ResetSimulation.Request.SCOPE_ALL)
RESETS = (*WHOLE, ResetSimulation.Request.SCOPE_STATE)  # the clock of the graph never falls back
LEVEL = 1e-3  # [rad] of pitch and roll that a pose on the ground may have


class ControlError(RoverError):
    """The simulator cannot do what it was asked for."""


class Controllable(Protocol):
    """A simulator; its methods raise ControlError."""

    @property
    def paused(self) -> bool:
        """Whether its time stands still."""

    def pause(self, paused: bool) -> None:
        """Let its time stand still, or pass."""

    def step(self, count: int) -> None:
        """So many steps while it is paused."""

    def reset(self) -> None:
        """Put everything where it was at the beginning."""

    def place(self, pose: Pose) -> None:
        """Put the robot somewhere, standing still."""


class SimulatorControl:
    """Offers the services for a node's simulator."""

    def __init__(self, node: Node, simulator: Controllable, entity: str, frame: str) -> None:
        """entity: name of the robot; frame: that of the world, for poses."""
        self._simulator, self._entity, self._frame = simulator, entity, frame
        services: dict[str, tuple[Any, Callable[..., Any]]] = {
            "get_simulator_features": (GetSimulatorFeatures, self._on_features),
            "get_simulation_state": (GetSimulationState, self._on_get_state),
            "set_simulation_state": (SetSimulationState, self._on_set_state),
            "reset_simulation": (ResetSimulation, self._on_reset),
            "step_simulation": (StepSimulation, self._on_step),
            "set_entity_state": (SetEntityState, self._on_place),
        }
        for name, (kind, callback) in services.items():
            node.create_service(kind, name, callback)

    def _on_features(self, _: Any, response: Any) -> Any:
        response.features.features = list(FEATURES)
        response.features.custom_info = "the parameter rate is the speed"
        return response

    def _on_get_state(self, _: Any, response: Any) -> Any:
        response.state.state = self._state()
        return _answered(response, lambda: None)

    def _on_set_state(self, request: Any, response: Any) -> Any:
        wanted = request.state.state
        if wanted == self._state():
            response.result.result = SetSimulationState.Response.ALREADY_IN_TARGET_STATE
            return response
        if wanted not in (
            SimulationState.STATE_STOPPED,
            SimulationState.STATE_PLAYING,
            SimulationState.STATE_PAUSED,
        ):
            return _refused(response, Result.RESULT_FEATURE_UNSUPPORTED, f"no state {wanted}")
        return _answered(response, lambda: self._bring_to(wanted))

    def _on_reset(self, request: Any, response: Any) -> Any:
        if request.scope not in RESETS:
            text = "the clock of the graph does not fall back, and nothing was spawned"
            return _refused(response, Result.RESULT_FEATURE_UNSUPPORTED, text)
        return _answered(response, self._simulator.reset)

    def _on_step(self, request: Any, response: Any) -> Any:
        if not self._simulator.paused:
            return _refused(response, Result.RESULT_OPERATION_FAILED, "it is not paused")
        return _answered(response, lambda: self._simulator.step(request.steps))

    def _on_place(self, request: Any, response: Any) -> Any:
        state = request.state
        if request.entity not in ("", self._entity):
            return _refused(response, Result.RESULT_NOT_FOUND, f"only {self._entity} is there")
        if state.header.frame_id not in ("", self._frame):
            text = f"a pose is to be in {self._frame}, not in {state.header.frame_id}"
            return _refused(response, SetEntityState.Response.INVALID_POSE, text)
        pose = _pose_of(state.pose)
        if pose is None:
            text = "no pose on level ground"
            return _refused(response, SetEntityState.Response.INVALID_POSE, text)
        return _answered(response, lambda: self._simulator.place(pose))

    def _state(self) -> int:
        if not self._simulator.paused:
            return int(SimulationState.STATE_PLAYING)
        return int(SimulationState.STATE_PAUSED)

    def _bring_to(self, state: int) -> None:
        self._simulator.pause(state != SimulationState.STATE_PLAYING)
        if state == SimulationState.STATE_STOPPED:
            self._simulator.reset()


def _answered(response: Any, step: Callable[[], None]) -> Any:
    try:
        step()
    except RoverError as error:
        return _refused(response, Result.RESULT_OPERATION_FAILED, str(error))
    response.result.result = Result.RESULT_OK
    return response


def _refused(response: Any, result: int, text: str) -> Any:
    response.result.result, response.result.error_message = result, text
    return response


def _pose_of(message: Any) -> Pose | None:
    """None where it is none on level ground; the height is that of the ground."""
    q, at = message.orientation, message.position
    values = (at.x, at.y, q.x, q.y, q.z, q.w)
    if not all(map(math.isfinite, values)) or abs(math.hypot(q.x, q.y, q.z, q.w) - 1.0) > LEVEL:
        return None
    roll, pitch, yaw = angles_from_quaternion(q.x, q.y, q.z, q.w)
    if max(abs(roll), abs(pitch)) > LEVEL:
        return None
    return Pose(at.x, at.y, yaw)
