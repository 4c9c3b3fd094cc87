"""The closed loop in one process, without ROS: simulator, perception and decision in turn.

It uses the same cores as the graph, the same values on the wire and the same rounding between the
nodes; a test compares it with the graph frame by frame.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from rover_bridge.codec import encode_drive
from rover_common.errors import RoverError
from rover_common.types import GridMap, RockTrack
from rover_decision.core import DecisionCore
from rover_decision.missions.sample_return import make_core
from rover_decision.missions.sample_return.chart import State
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.types import Decision, Frame
from rover_perception.config import PerceptionConfig
from rover_simulator.simulation import Simulation
from rover_tools.evaluation.observer import Observer


class PlanError(RoverError):
    """The planner, or an explorer in it, raised an error."""


@dataclass(frozen=True)
class LoopResult:
    """How a mission ended."""

    done: bool  # as the mission itself reports
    decision: Decision
    world_map: GridMap
    rocks: tuple[RockTrack, ...]
    track: NDArray[np.float64]  # (n, 2) [m] true positions, one a second


class Loop:
    """One mission, one frame at a time."""

    def __init__(
        self,
        simulation: Simulation,
        decision: DecisionConfig | None = None,
        perception: PerceptionConfig | None = None,
        *,
        core: DecisionCore | None = None,
    ) -> None:
        """`core` takes the place of the one that `decision` describes."""
        self.simulation = simulation
        self._observer = Observer(simulation, perception)
        self.perception = self._observer.perception
        self.core = core or make_core(decision or DecisionConfig(), lockstep=True)
        self.frame: Frame | None = None  # the newest that was decided on

    def close(self) -> None:
        self.core.close()

    def run(
        self, time_limit: float, watch: Callable[[Decision], object] | None = None
    ) -> LoopResult:
        """Run until the mission is over or the simulated time reaches `time_limit` [s].

        Raises PlanError where the planner did: the mission holds then, and goes home.
        """
        # The simulator sends two telemetries when it connects, and advances when both are answered.
        answers = [self.decide(), self.decide()]
        track = [self._position()]
        while True:
            decision = answers[-1]
            for answer in answers:
                self.answer(answer)
            if decision.state is State.DONE or self.simulation.time >= time_limit:
                break
            self.simulation.advance()
            if self.simulation.time >= len(track) + 1.0:
                track.append(self._position())
            answers = [self.decide()]
            if self.core.plan_failures:
                raise PlanError(f"the planner failed: {self.core.last_failure}")
            if watch is not None:
                watch(answers[-1])
        track.append(self._position())
        done, rocks = decision.state is State.DONE, self._observer.rocks
        return LoopResult(done, decision, self.perception.world_map(), rocks, np.array(track))

    def decide(self) -> Decision:
        """Process one telemetry of the simulator's present frame."""
        self.frame = frame = self._observer.observe()
        decision = self.core.step(frame)
        if frame.needs_plan:
            self.core.give_map(frame.stamp, self.perception.navigation_map())
        if decision.command.new_run:
            self._observer.begin_run()
        return decision

    def answer(self, decision: Decision) -> None:
        """Send the decision's command to the simulator."""
        if decision.command.pickup:
            self.simulation.handle("pickup", {})
        else:
            self.simulation.handle("data", encode_drive(decision.command))

    def _position(self) -> tuple[float, float]:
        return self.simulation.pose.x, self.simulation.pose.y
