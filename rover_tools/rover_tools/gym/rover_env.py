"""The step API of Gymnasium over the embedded simulator: an agent in place of the decision node."""

from __future__ import annotations

import math
from typing import Any

import gymnasium
import numpy as np
from numpy.typing import NDArray

from rover_bridge.codec import encode_drive
from rover_common.types import Command
from rover_common.vehicle import ROVER
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.types import Frame
from rover_perception.config import PerceptionConfig
from rover_simulator.run import frame_steps_of
from rover_simulator.simulation import START_TIME, Simulation
from rover_simulator.vehicle.vehicle import STEP
from rover_simulator.world.generator import generate_world
from rover_tools.evaluation.observer import Observer
from rover_tools.gym.spaces import Observation, action_space, command_of, observation_of
from rover_tools.gym.spaces import observation_space as spaces_of

WORLDS = 2**31  # seeds that are drawn from
CONTACT_COST = 0.1  # of touching a wall or a rock


class RoverEnv(gymnasium.Env[Observation, Any]):  # actions: (4,), as in spaces.action_space
    """Collect all samples of a generated canyon and come home; one step is one camera frame.

    Reward: 1 for each sample on board, 1 for being home with all of them, -0.1 for each contact
    with a wall or a rock. Terminated: home with all samples. Truncated: at the time limit.
    `info` has `time` [s] since the reset, `distance` [m] driven, `contacts` and `world`, the seed
    of the canyon as for `./rover mission --seed`.
    """

    metadata: dict[str, Any] = {"render_modes": ["rgb_array"], "render_fps": 12}  # noqa: RUF012

    def __init__(
        self,
        render_mode: str | None = None,
        *,
        size: float = 0.4,
        fps: float = 12.5,
        time_limit: float = 600.0,
    ) -> None:
        """size: of the canyons, 0.2 to 2; fps: frames per simulated second; time_limit: [s]."""
        self.render_mode = render_mode
        self._size, self._time_limit = size, time_limit
        self._frame_steps = frame_steps_of(fps)
        self.metadata = self.metadata | {"render_fps": round(1 / (self._frame_steps * STEP))}
        self._config = PerceptionConfig()
        self.observation_space = spaces_of(self._config.max_range)
        self.action_space = action_space()
        self._world_seed = 0
        self._simulation: Simulation | None = None

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Observation, dict[str, Any]]:
        """A new canyon, drawn from the seed, or after earlier ones; options: `world`, its seed."""
        super().reset(seed=seed)
        drawn = int(self.np_random.integers(WORLDS))
        self._world_seed = int((options or {}).get("world", drawn))
        world = generate_world(self._world_seed, self._size)
        self._simulation = Simulation(world, self._world_seed, self._frame_steps)
        self._observer = Observer(self._simulation, self._config, crop=False)
        self._home = world.start.x, world.start.y
        self._frame = self._observer.observe()
        return self._observation(), self._info(self._simulation)

    def step(
        self, action: NDArray[np.floating]
    ) -> tuple[Observation, float, bool, bool, dict[str, Any]]:
        """Drive on for one frame; raises ResetNeeded before the first reset."""
        simulation = self._simulation
        if simulation is None:
            raise gymnasium.error.ResetNeeded("call reset before step")
        before, contacts = simulation.samples_left, simulation.contacts
        self._send(simulation, command_of(action))
        simulation.advance()
        self._frame = frame = self._observer.observe()
        reward = float(before - simulation.samples_left)
        reward -= CONTACT_COST * (simulation.contacts - contacts)
        terminated = simulation.samples_left == 0 and self._at_home(frame)
        truncated = simulation.time - START_TIME >= self._time_limit
        info = self._info(simulation)
        return self._observation(), reward + terminated, terminated, truncated, info

    def render(self) -> NDArray[np.uint8] | None:  # type: ignore[override]
        """The camera's newest image (height, width, 3) RGB; None in no render mode."""
        if self.render_mode is None or self._simulation is None:
            return None
        return np.array(self._image())

    def _send(self, simulation: Simulation, command: Command) -> None:
        """A pickup that the simulator would freeze at for good becomes the brake."""
        vehicle = self._frame.vehicle
        if not command.pickup:
            simulation.handle("data", encode_drive(command))
        elif vehicle.near_sample and abs(vehicle.speed) <= ROVER.pickup_speed:
            simulation.handle("pickup", {})
        else:
            simulation.handle("data", encode_drive(Command(brake=1.0)))

    def _at_home(self, frame: Frame) -> bool:
        distance = math.dist(self._home, (frame.pose.x, frame.pose.y))
        return distance <= DecisionConfig().home_radius and not frame.vehicle.picking_up

    def _image(self) -> NDArray[np.uint8]:
        assert self._observer.telemetry is not None
        return self._observer.telemetry.image

    def _observation(self) -> Observation:
        return observation_of(self._frame, self._image(), self._config.max_range)

    def _info(self, simulation: Simulation) -> dict[str, Any]:
        return {
            "time": simulation.time - START_TIME,
            "distance": simulation.distance,
            "contacts": simulation.contacts,
            "world": self._world_seed,
        }
