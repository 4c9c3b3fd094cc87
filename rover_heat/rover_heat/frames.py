"""Frames out of batches: what node and loop share, so that both run the same mission."""

from __future__ import annotations

from rover_common.sensor_types import SensorBatch, Twist
from rover_common.types import FIRST_RUN, GridMap, Run
from rover_heat.config import HeatConfig
from rover_heat.types import HeatFrame
from rover_navigation.transform_buffer import TransformBuffer


class FrameAssembler:
    """Keeps the newest of what comes seldom, and says when a plan is due."""

    def __init__(self, config: HeatConfig, poses: TransformBuffer) -> None:
        self._poses = poses
        self._plan_period = round(1e9 / config.control_rate)  # [ns]
        self._plan_due = 0  # [ns]
        self._grid: GridMap | None = None
        self._twist = Twist()
        self.run = FIRST_RUN

    def begin_run(self, stamp: int) -> None:
        """Another run begins with the frames after this stamp [ns]."""
        self.run = Run(self.run.number + 1, stamp + 1)

    def give_map(self, grid: GridMap) -> None:
        """A new map has come."""
        self._grid = grid

    def frame(self, batch: SensorBatch) -> HeatFrame:
        """The frame of a batch, with the newest pose that the transforms tell."""
        if batch.odometry:
            self._twist = batch.odometry[-1].twist
        pose_stamp, pose = self._poses.latest() or (0, None)
        due = batch.stamp >= self._plan_due and self._grid is not None and pose is not None
        if due:
            self._plan_due = batch.stamp + self._plan_period
        return HeatFrame(
            stamp=batch.stamp,
            poses=self._poses,
            pose=pose,
            pose_stamp=pose_stamp,
            grid=self._grid,
            scans=batch.scans,
            imus=batch.imus,
            thermal=batch.thermal,
            twist=self._twist,
            launches_done=batch.launches_done,
            run=self.run,
            needs_plan=due,
        )
