"""What an agent observes and does, with units: frames to arrays, arrays to commands.

Every array keeps within its space, whatever the rover does: values beyond are clipped.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from rover_common.camera import ROVER_CAMERA
from rover_common.grid import WORLD
from rover_common.types import Command
from rover_common.vehicle import ROVER
from rover_decision.types import Frame
from rover_perception.mapping.free_scan import COUNT

Observation = dict[str, Any]

MOST_SAMPLES = 100  # a world holds no more
TILT = math.pi / 2
# x, y [m], yaw, pitch, roll [rad] and speed [m/s], forward positive
LEAST_POSE = (0.0, 0.0, -math.pi, -TILT, -TILT, -ROVER.max_speed)
MOST_POSE = (WORLD.size, WORLD.size, math.pi, TILT, TILT, ROVER.max_speed)
POSE = spaces.Box(np.array(LEAST_POSE, np.float32), np.array(MOST_POSE, np.float32))
IMAGE = spaces.Box(0, 255, (ROVER_CAMERA.height, ROVER_CAMERA.width, 3), np.uint8)  # RGB


def observation_space(max_range: float) -> spaces.Dict:
    """max_range: [m] of the free scan; farther is as far."""
    return spaces.Dict(
        {
            "image": IMAGE,
            "pose": POSE,
            # [m] free ground at each bearing, from the right to the left, a degree apart
            "free_scan": spaces.Box(0.0, max_range, (COUNT,), np.float32),
            "near_sample": spaces.Discrete(2),  # a sample is in reach of the arm
            "picking_up": spaces.Discrete(2),  # the arm works: 10 s, no command counts
            "samples_left": spaces.Discrete(MOST_SAMPLES + 1),
        }
    )


def action_space() -> spaces.Box:
    """Throttle -1..1, brake 0..1, steering angle [rad] left positive; above 0.5: pick up."""
    most = ROVER.max_steering
    low, high = (-1.0, 0.0, -most, 0.0), (1.0, 1.0, most, 1.0)
    return spaces.Box(np.array(low, np.float32), np.array(high, np.float32))


def observation_of(frame: Frame, image: NDArray[np.uint8], max_range: float) -> Observation:
    """image: (height, width, 3) RGB, of the frame; max_range: [m] of the free scan."""
    vehicle, pose = frame.vehicle, frame.pose
    values = pose.x, pose.y, pose.yaw, pose.pitch, pose.roll, vehicle.speed
    return {
        "image": np.array(image),
        "pose": np.clip(np.array(values, np.float32), POSE.low, POSE.high),
        "free_scan": np.clip(frame.scan.ranges, 0.0, np.float32(max_range)),
        "near_sample": int(vehicle.near_sample),
        "picking_up": int(vehicle.picking_up),
        "samples_left": vehicle.sample_count,
    }


def command_of(action: NDArray[np.floating]) -> Command:
    """action: (4,) as in `action_space`; values beyond it count as its limits."""
    space = action_space()
    throttle, brake, steering, pickup = np.clip(action, space.low, space.high)
    return Command(float(throttle), float(brake), float(steering), pickup=bool(pickup > 0.5))
