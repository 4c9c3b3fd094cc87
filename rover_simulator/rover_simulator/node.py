"""The embedded simulator as a node: started by launch, controlled by services.

It is the same client of the same server as `rover sim`; this node has no topic but /diagnostics.
Services: those of simulation_interfaces. A lifecycle node. Parameters: SimulatorConfig.
"""

from __future__ import annotations

import math
import threading
from collections import deque
from collections.abc import Callable
from typing import Any

from rclpy.clock import Clock, ClockType

from rover_common.geometry import Pose
from rover_common.ros.diagnostics import NodeDiagnostics
from rover_common.ros.lifecycle import ManagedNode
from rover_common.ros.parameters import declare_parameters
from rover_common.ros.runner import run_node
from rover_common.ros.simulator_control import ControlError, SimulatorControl
from rover_simulator.config import SimulatorConfig
from rover_simulator.gate import StepGate
from rover_simulator.run import frame_steps_of
from rover_simulator.simulation import Simulation
from rover_simulator.vehicle.vehicle import STEP
from rover_simulator.wire.pacing import LockstepPacing, Pacing, TimedPacing, run_connected
from rover_simulator.wire.unity_client import UnityClient

ENTITY, WORLD = "rover", "map"  # of the services
PATIENCE = 5.0  # [s] for the simulation's thread to do what is asked
STEP_PATIENCE = 60.0  # [s] for frames, which may wait for a server
TOLD = 3  # messages at a time
LOOK = 0.5  # [s] of wall time between two looks whether the simulation has ended


class SimulatorNode(ManagedNode):
    """The simulation has a thread of its own while the node is configured."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("simulator_node", **kwargs)
        self._ended, self._changed = threading.Event(), threading.Event()
        self._thread: threading.Thread | None = None
        self.bring_up(self._prepare)

    def _prepare(self) -> None:
        self._config = declare_parameters(self, SimulatorConfig, self._on_config)
        self._frame_steps = frame_steps_of(self._config.fps)
        self._paused = self._config.start_paused
        self._gate = StepGate(closed=True)
        # what the thread has to tell of its connection; the latest of what comes faster than that
        self._told: deque[str] = deque(maxlen=TOLD)
        self.simulation: Simulation | None = None
        self._diagnostics = NodeDiagnostics(self, {})
        SimulatorControl(self, self, ENTITY, WORLD)
        wall = Clock(clock_type=ClockType.STEADY_TIME)
        self._timer = self.create_timer(LOOK, self._look, clock=wall)

    def configure(self) -> None:
        """Make the world, and connect to the server."""
        config = self._config
        self.simulation = Simulation(
            config.load(), config.seed, self._frame_steps, config.dead_man or math.inf
        )
        self._ended.clear()
        self._thread = threading.Thread(target=self._run, name="simulation", daemon=True)
        self._thread.start()

    def activate(self) -> None:
        """Let time pass, unless it is paused."""
        self._gate.close(self._paused)

    def deactivate(self) -> None:
        """Let time stand still."""
        self._gate.close(True)

    def cleanup(self) -> None:
        """Leave the server."""
        self._ended.set()
        if self._thread is not None:
            self._thread.join(PATIENCE)
        self._thread = None

    def destroy_node(self) -> None:
        """End the simulation's thread, then the node."""
        self.cleanup()
        super().destroy_node()

    @property
    def paused(self) -> bool:
        """Whether time stands still."""
        return self._gate.closed

    def pause(self, paused: bool) -> None:
        """Let time stand still, or pass."""
        if not self.active:
            raise ControlError("the node is not active")
        self._paused = paused
        self._gate.close(paused)

    def step(self, count: int) -> None:
        """So many frames, while it is paused."""
        if not self._gate.step(count, STEP_PATIENCE):
            raise ControlError("the frames were not made in time: does the server answer?")

    def reset(self) -> None:
        """The rover and the samples are where they were; the simulator's clock begins again."""
        self._have_done(lambda simulation: simulation.reset())

    def place(self, pose: Pose) -> None:
        """On navigable ground."""

        def put(simulation: Simulation) -> None:
            problem = simulation.place(pose)
            if problem:
                raise ControlError(problem)

        self._have_done(put)

    def _have_done(self, task: Callable[[Simulation], None]) -> None:
        simulation = self.simulation
        if simulation is None or self._thread is None:
            raise ControlError("the node is not configured")
        if not self._gate.do(lambda: task(simulation), PATIENCE):
            raise ControlError("the simulation does not listen")

    def _on_config(self, config: SimulatorConfig) -> None:
        """Another speed: the simulation connects again, and goes on with its run."""
        self._config = config
        self._changed.set()

    def _run(self) -> None:
        """The simulation's thread."""
        assert self.simulation is not None
        client = UnityClient(self._config.host, self._config.port, self._told.append)
        while not self._is_over():
            self._changed.clear()
            pacing = self._pacing(self.simulation)
            run_connected(client, pacing, self._is_interrupted, self._told.append)

    def _is_interrupted(self) -> bool:
        return self._is_over() or self._changed.is_set()

    def _is_over(self) -> bool:
        assert self.simulation is not None
        limit = self._config.time_limit or math.inf
        return self._ended.is_set() or self.simulation.time >= limit

    def _pacing(self, simulation: Simulation) -> Pacing:
        if self._config.rate == 0.0:
            return LockstepPacing(simulation, lambda: None, self._gate)
        period = self._frame_steps * STEP / self._config.rate
        return TimedPacing(simulation, lambda: None, period, self._gate)

    def _look(self) -> None:
        """What the simulation's thread has to tell; the node ends with it."""
        while self._told:
            self.get_logger().warning(self._told.popleft())
        simulation = self.simulation
        if simulation is not None:
            self._diagnostics.counts["contacts"] = simulation.contacts
            self._diagnostics.counts["samples_left"] = simulation.samples_left
            self._diagnostics.counts["dead_man_stops"] = simulation.dead_man_stops
        if self._thread is not None and not (self._thread.is_alive() or self._ended.is_set()):
            self.get_logger().info("the simulation has ended")
            self.context.try_shutdown()


def main() -> None:
    """Entry point of `ros2 run rover_simulator simulator_node`."""
    run_node(SimulatorNode)
