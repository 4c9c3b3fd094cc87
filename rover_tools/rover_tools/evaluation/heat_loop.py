"""The heat mission's closed loop in one process, without ROS: simulator, navigator, mission.

It uses the same cores as the graph, one batch of the sensors after the other.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from burger_simulator.simulation import BurgerSimulation
from burger_simulator.truth import Truth
from rover_common.burger import BURGER
from rover_common.geometry import Pose, compose, through_quaternion
from rover_common.sensor_types import SensorBatch, Twist
from rover_common.types import GridMap
from rover_heat.config import HeatConfig
from rover_heat.frames import FrameAssembler
from rover_heat.mission import HeatCore, make_core
from rover_heat.mission.chart import State
from rover_heat.mission.ownership import STAND
from rover_heat.ramp.hazards import NO_HAZARDS
from rover_heat.types import HeatDecision, HeatFrame, HeatOverlay
from rover_navigation.burger_scale import BURGER_SCALE
from rover_navigation.embedded_navigator import EmbeddedNavigator, NavigatorOutput
from rover_navigation.navigator import Navigator
from rover_navigation.navigator_config import NavigatorConfig
from rover_navigation.reported_goal import ReportingNavigator
from rover_navigation.transform_buffer import TransformBuffer

ENDS = {State.DONE, State.FAILED}


@dataclass(frozen=True)
class HeatStep:
    """One tick, with what is true: for records and scores only."""

    frame: HeatFrame
    decision: HeatDecision
    twist: Twist | None  # that the wheels were told
    truth: Truth
    cpu_seconds: float  # [s] of the core's time for the frame and the decision; plans are beside it


@dataclass(frozen=True)
class HeatResult:
    """How a mission ended."""

    done: bool  # as the mission itself reports
    decision: HeatDecision
    overlay: HeatOverlay
    grid: GridMap | None
    truth: Truth
    map_in_world: Pose  # the map's frame, which begins where the robot stood
    track: NDArray[np.float64]  # (n, 6) [m, rad] true x, y, yaw and estimated ones, in the world
    early_ascent: float  # [m] of the axle beyond the foot before the ramp was attempted


class HeatLoop:
    """One mission, one tick at a time."""

    def __init__(
        self,
        simulation: BurgerSimulation,
        config: HeatConfig | None = None,
        navigation: NavigatorConfig | None = None,
        seed: int = 0,
        *,
        core: Callable[[HeatConfig, Navigator], HeatCore] | None = None,
    ) -> None:
        """`seed`: of the navigator's samples; `core` takes the place of the mission's own."""
        self.simulation = simulation
        self._config = config or HeatConfig()
        settings = navigation or NavigatorConfig()
        self.navigator = EmbeddedNavigator(BURGER, BURGER_SCALE, settings, seed)
        self._goals = ReportingNavigator(self.navigator, settings.goal_tolerance)
        self._poses = TransformBuffer()
        make = core or (lambda c, navigator: make_core(c, navigator, lockstep=True))
        self.core = make(self._config, self._goals)
        self.grid: GridMap | None = None
        self._frames = FrameAssembler(self._config, self._poses)
        self._hazards = NO_HAZARDS
        self._twist: Twist | None = None
        self._launch = False
        self._map_in_world = simulation.truth.pose

    def close(self) -> None:
        self.core.close()

    def run(
        self, time_limit: float, watch: Callable[[HeatStep], object] | None = None
    ) -> HeatResult:
        """Run until the mission ends or the simulated time reaches `time_limit` [s]."""
        track: list[tuple[float, ...]] = []
        ascent = 0.0
        attempted = False
        while True:
            step = self.step()
            truth, state = step.truth, step.decision.state
            attempted |= state is State.ATTEMPTING_RAMP
            if not attempted:
                ascent = max(ascent, truth.beyond_foot)
            if truth.time >= len(track) + 1.0 and step.frame.pose is not None:
                track.append(self._placed(truth.pose, step.frame.pose))
            if watch is not None:
                watch(step)
            if state in ENDS or truth.time >= time_limit:
                break
        return HeatResult(
            done=state is State.DONE,
            decision=step.decision,
            overlay=self.core.mission.overlay(),
            grid=self.grid,
            truth=truth,
            map_in_world=self._map_in_world,
            track=np.array(track, float).reshape(-1, 6),
            early_ascent=ascent,
        )

    def step(self) -> HeatStep:
        """One tick: the robot moves, the sensors speak, the navigator and the mission decide."""
        batch = self.simulation.step(self._twist, self._launch)
        output = self.navigator.step(batch)
        self._goals.report()
        self._take_transforms(batch, output)
        if output.map is not None:
            self.grid = output.map
            self._frames.give_map(output.map)
        cpu = time.thread_time()
        frame = self._frames.frame(batch)
        if self.grid is not None:
            self.core.give_map(frame.stamp, self.grid)
        decision = self.core.step(frame)
        cpu = time.thread_time() - cpu
        if decision.new_run:
            self._frames.begin_run(frame.stamp)
        redraw = output.map is not None or decision.hazards != self._hazards
        if redraw and self.grid is not None:
            self._hazards = decision.hazards
            self.navigator.set_hazards(decision.hazards.drawn_into(self.grid))
        # Who drives is known to the navigator a tick after it was decided.
        self._twist = output.twist or decision.twist or STAND
        self._launch = decision.launch
        return HeatStep(frame, decision, self._twist, self.simulation.truth, cpu)

    def _take_transforms(self, batch: SensorBatch, output: NavigatorOutput) -> None:
        """As they arrive by messages."""
        for odometry in batch.odometry:
            self._poses.add_odometry(odometry.stamp, through_quaternion(odometry.pose))
        if output.map_to_odom is not None:
            self._poses.add_correction(output.stamp, through_quaternion(output.map_to_odom))

    def _placed(self, true: Pose, estimated: Pose) -> tuple[float, ...]:
        placed = compose(self._map_in_world, estimated)
        return (true.x, true.y, true.yaw, placed.x, placed.y, placed.yaw)
