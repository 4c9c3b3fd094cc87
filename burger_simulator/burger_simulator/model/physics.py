"""The model in motion: what the wheels are told, where the body is, what rays hit."""

from __future__ import annotations

from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from burger_simulator.model.mjcf import model_of
from burger_simulator.model.robot import GROUP
from burger_simulator.world.maze import Maze
from rover_common.geometry import Pose, angles_from_quaternion, quaternion_from_pose

SETTLING = 100  # steps before anything is measured, in which the body comes to rest on its wheels
OTHER, WALL, RAMP, BODY = 0, 1, 2, 4  # kinds of geoms

Vector = NDArray[np.float64]


class Physics:
    """All that it shows belongs to one instant, the accelerations to the step that led there."""

    def __init__(self, maze: Maze, box: bool) -> None:
        self._model = model_of(maze, box)
        self._data = mujoco.MjData(self._model)
        self._kinds = np.array([_kind(self._model.geom(i)) for i in range(self._model.ngeom)])
        self._seen = np.ones(6, np.uint8)  # groups of geoms that rays can hit
        self._seen[GROUP] = 0
        self._base = self._data.body("base")
        self._imu = self._data.site("imu")
        mujoco.mj_step1(self._model, self._data)
        for _ in range(SETTLING):
            self.advance()
        self._level = float(self._data.qpos[2])  # [m] of the body on level ground

    def advance(self) -> None:
        """One step; in two halves, so that positions and rates are those after it."""
        mujoco.mj_step2(self._model, self._data)
        mujoco.mj_step1(self._model, self._data)

    def place(self, pose: Pose) -> bool:
        """Put the body on level ground, standing; False, and as before, where it is not free."""
        before = self._data.qpos.copy(), self._data.qvel.copy()
        x, y, z, w = quaternion_from_pose(Pose(pose.x, pose.y, pose.yaw))
        self._data.qpos[:7] = (pose.x, pose.y, self._level, w, x, y, z)
        self._data.qvel[:] = 0.0
        mujoco.mj_step1(self._model, self._data)
        free = not any(self.touches())
        if not free:
            self._data.qpos[:], self._data.qvel[:] = before
            mujoco.mj_step1(self._model, self._data)
        return free

    def drive(self, left: float, right: float) -> None:
        """Speeds [rad/s] that the wheels' servos go for."""
        self._data.ctrl[0], self._data.ctrl[1] = left, right

    @property
    def position(self) -> Vector:
        """(3,) [m] of base_footprint."""
        return self._base.xpos

    @property
    def rotation(self) -> Vector:
        """(3, 3) from base_footprint to the world."""
        return self._base.xmat.reshape(3, 3)

    @property
    def pose(self) -> Pose:
        w, x, y, z = self._base.xquat
        roll, pitch, yaw = angles_from_quaternion(x, y, z, w)
        return Pose(float(self.position[0]), float(self.position[1]), yaw, pitch, roll)

    @property
    def speed(self) -> float:
        """[m/s] along the body, forward positive."""
        return float(self._data.qvel[:3] @ self.rotation[:, 0])

    @property
    def turn_rate(self) -> float:
        """[rad/s] around the body's upright axis."""
        return float(self._data.qvel[5])

    @property
    def wheel_angles(self) -> tuple[float, float]:
        """[rad] left and right, forward positive."""
        return float(self._data.qpos[7]), float(self._data.qpos[8])

    @property
    def gyro(self) -> Vector:
        """(3,) [rad/s] in the inertial unit's axes."""
        return self._data.sensordata[:3]

    @property
    def accelerometer(self) -> Vector:
        """(3,) [m/s^2] in the inertial unit's axes, upwards 9.8 at rest."""
        return self._data.sensordata[3:6]

    def touches(self) -> tuple[bool, bool]:
        """Whether any part of it touches a wall, and its body the ramp, where wheels belong."""
        pairs = self._kinds[self._data.contact.geom].sum(axis=1).tolist()
        return any(pair & WALL for pair in pairs), BODY | RAMP in pairs

    def cast(self, origin: Vector, directions: Vector, reach: float) -> Vector:
        """Distances (n,) [m] along rays of the world frame (n, 3), `reach` where all is free."""
        count = len(directions)
        distances = np.empty(count)
        geoms = np.empty(count, np.int32)
        mujoco.mj_multiRay(
            self._model, self._data, origin, directions.ravel(), self._seen, 1, -1, geoms,
            distances, None, count, reach,
        )  # fmt: skip
        distances[geoms < 0] = reach
        return distances


def _kind(geom: Any) -> int:
    """As a bit, so that the sum of two tells which kinds touch."""
    if geom.name.startswith("wall_"):
        return WALL
    if geom.name.startswith("ramp_"):
        return RAMP
    return BODY if geom.name == "chassis" else OTHER
