"""Model predictive path integral control of a differential drive (Williams et al., 2017).

Sampled velocity sequences are rolled out, each is given a cost, and the next sequence is their mean
weighted by exp(-cost / temperature). Arrays are (steps, samples), float32, allocated once.
"""

from __future__ import annotations

import numpy as np

from rover_common.burger import BurgerModel
from rover_common.geometry import Pose
from rover_common.sensor_types import Twist
from rover_navigation.control.critics import Scene, Trajectories, cost_of

STEPS = 40
PERIOD = 0.05  # [s] of a step, and between two calls
HELD = 4  # steps that one drawn velocity is held: longer ones reach farther than white noise
LINEAR_SIGMA, ANGULAR_SIGMA = 0.08, 0.9  # [m/s], [rad/s] of the draws
BACKWARD = -0.06  # [m/s] fastest
TEMPERATURE = 0.15
ACCELERATION, TURN_ACCELERATION = 1.0, 8.0  # [m/s^2], [rad/s^2] of what is told to the wheels


class Mppi:
    """Keeps its last sequence, as the mean of the next draws."""

    def __init__(self, model: BurgerModel, samples: int, generator: np.random.Generator) -> None:
        self._model = model
        self._generator = generator
        self._draws = np.empty((2, STEPS // HELD, samples), np.float32)
        shape = (STEPS, samples)
        self._linear, self._angular = np.empty(shape, np.float32), np.empty(shape, np.float32)
        self._paths = Trajectories.empty(shape)
        self._mean = np.zeros((2, STEPS), np.float32)  # linear, angular

    def restart(self) -> None:
        """Forget the last sequence: the robot stands."""
        self._mean[:] = 0.0

    def twist(self, pose: Pose, last: Twist, scene: Scene) -> Twist:
        """The velocity for the next period. `last` is the one that was told before."""
        self._draw()
        self._roll_out(pose)
        cost = cost_of(self._paths, self._linear, self._angular, scene)
        weight = np.exp((cost.min() - cost) / np.float32(TEMPERATURE))
        weight /= weight.sum()
        self._mean[0] = (self._linear * weight).sum(axis=1)
        self._mean[1] = (self._angular * weight).sum(axis=1)
        linear, angular = (float(value) for value in self._mean[:, 0])
        self._mean[:, :-1] = self._mean[:, 1:]
        return Twist(
            _towards(last.linear, linear, ACCELERATION * PERIOD),
            _towards(last.angular, angular, TURN_ACCELERATION * PERIOD),
        )

    def _draw(self) -> None:
        """Velocities around the mean, within the limits; the first sample is the mean itself."""
        self._generator.standard_normal(out=self._draws, dtype=np.float32)
        self._draws[:, :, 0] = 0.0
        limits = (
            (self._linear, LINEAR_SIGMA, BACKWARD, self._model.cruise_speed),
            (self._angular, ANGULAR_SIGMA, -self._model.cruise_turn, self._model.cruise_turn),
        )
        for index, (values, sigma, least, most) in enumerate(limits):
            held = values.reshape(STEPS // HELD, HELD, -1)
            held[:] = self._draws[index][:, None] * np.float32(sigma)
            values += self._mean[index][:, None]
            np.clip(values, least, most, out=values)

    def _roll_out(self, pose: Pose) -> None:
        paths, period = self._paths, np.float32(PERIOD)
        yaw = np.cumsum(self._angular, axis=0, out=paths.yaw)
        yaw *= period
        yaw += np.float32(pose.yaw)
        for axis, function, start in ((paths.x, np.cos, pose.x), (paths.y, np.sin, pose.y)):
            function(yaw, out=axis)
            axis *= self._linear
            np.cumsum(axis, axis=0, out=axis)
            axis *= period
            axis += np.float32(start)


def _towards(value: float, target: float, step: float) -> float:
    return value + min(step, max(-step, target - value))
