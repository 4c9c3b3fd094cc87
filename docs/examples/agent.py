"""An agent on the step API: it drives to where most ground is free, and brakes at a sample.

./rover shell -c 'python docs/examples/agent.py'
"""

from __future__ import annotations

from typing import Any

import gymnasium
import numpy as np

import rover_tools.gym  # registers Rover-v0

TOP_SPEED = 2.0  # [m/s]


def act(observation: dict[str, Any]) -> np.ndarray:
    """Throttle, brake, steering angle [rad], pickup."""
    speed = observation["pose"][5]
    if observation["near_sample"]:
        return np.array([0.0, 1.0, 0.0, abs(speed) < 0.1], np.float32)
    scan = observation["free_scan"]  # [m] from 54 degrees to the right to 54 to the left
    bearings = np.radians(np.arange(len(scan)) - len(scan) // 2)
    bearing = float(np.average(bearings, weights=scan**2))
    if scan[len(scan) // 2 - 10 : len(scan) // 2 + 11].min() < 1.2 + 0.5 * speed:
        if speed > 0.3:
            return np.array([0.0, 1.0, 0.0, 0.0], np.float32)
        return np.array([0.0, 0.0, 0.26, 0.0], np.float32)  # in place, to the left
    return np.array([0.5 * (speed < TOP_SPEED), 0.0, bearing, 0.0], np.float32)


def run(world: int = 1, size: float = 0.4, time_limit: float = 120.0) -> dict[str, Any]:
    """One episode; its last `info`."""
    env = gymnasium.make(rover_tools.gym.ID, size=size, time_limit=time_limit)
    observation, info = env.reset(options={"world": world})
    total, over = 0.0, False
    while not over:
        observation, reward, terminated, truncated, info = env.step(act(observation))
        total, over = total + float(reward), terminated or truncated
    env.close()
    return info | {"reward": total, "samples_left": observation["samples_left"]}


if __name__ == "__main__":
    print(run())
