"""The steps of the closed loop as what a report and a video of the mission show."""

from __future__ import annotations

from dataclasses import replace

from rover_common.geometry import Pose, angles_from_quaternion, compose, distance_between
from rover_common.types import GridMap
from rover_heat.thermal.picture import Celsius
from rover_heat.types import HeatOverlay
from rover_tools.evaluation.heat_loop import HeatLoop, HeatStep
from rover_tools.report.heat_log import BLANK, ORIGIN, HeatLogBuilder, HeatMoment
from rover_tools.report.video.heat_scene import HeatSnapshot


class StepWatch:
    """Takes every step of a loop, and keeps a log and a snapshot a second."""

    def __init__(self, map_in_world: Pose) -> None:
        self.log = HeatLogBuilder()
        self.snapshots: list[HeatSnapshot] = []
        self._map_in_world = map_in_world
        self._thermal: list[Celsius] = [BLANK, BLANK]
        self._tilt = (0.0, 0.0)  # [rad] pitch and roll, the newest
        self._explored = 0.0
        self._last: HeatMoment | None = None
        self._seen = HeatOverlay()  # the newest that has faces

    def __call__(self, loop: HeatLoop, step: HeatStep) -> None:
        moment = self._moment_of(step)
        self.log.add(moment)
        self._last = moment
        if moment.time >= len(self.snapshots):
            overlay = self.with_faces(loop.core.mission.overlay())
            self.snapshots.append(HeatSnapshot(moment, loop.grid, overlay))

    def end(self, grid: GridMap | None, overlay: HeatOverlay) -> None:
        """The last step is a snapshot as well."""
        if self._last is not None and self.snapshots[-1].moment is not self._last:
            self.snapshots.append(HeatSnapshot(self._last, grid, self.with_faces(overlay)))

    def with_faces(self, overlay: HeatOverlay) -> HeatOverlay:
        """Beside exploring, a plan has none: those of the last one that had."""
        if len(overlay.faces) or len(overlay.open_faces):
            self._seen = overlay
        return replace(overlay, faces=self._seen.faces, open_faces=self._seen.open_faces)

    def _moment_of(self, step: HeatStep) -> HeatMoment:
        frame, decision = step.frame, step.decision
        for thermal in frame.thermal:
            self._thermal[thermal.sensor - 1] = thermal.celsius
        for imu in frame.imus[-1:]:
            if imu.orientation is not None:
                roll, pitch, _ = angles_from_quaternion(*imu.orientation)
                self._tilt = pitch, roll
        pose = frame.pose or ORIGIN
        placed = compose(self._map_in_world, pose)
        known = decision.progress
        self._explored = known.explored or self._explored  # none is told beside exploring
        return HeatMoment(
            time=known.elapsed,
            pose=replace(pose, pitch=self._tilt[0], roll=self._tilt[1]),
            speed=frame.twist.linear,
            state=decision.state.name,
            reason=decision.reason,
            sources_known=known.sources_known,
            sources_delivered=known.sources_delivered,
            payloads=known.payloads,
            distance=known.distance,
            explored=self._explored,
            thermal=(self._thermal[0], self._thermal[1]),
            error=None if frame.pose is None else distance_between(step.truth.pose, placed),
        )
