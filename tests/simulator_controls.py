"""A simulation in a hall, commands for it, and the controls that it reports."""

from __future__ import annotations

from functools import cache

import numpy as np

from rover_common.geometry import Pose
from rover_simulator.simulation import Simulation
from rover_simulator.world.world import World

HALL = np.zeros((200, 200), bool)
HALL[80:121, 80:121] = True
FRAME = 0.04  # [s]
BEFORE = {"steering_angle": "5", "throttle": "0.5", "brake": "0.25"}
GOOD = {"steering_angle": "-3", "throttle": "0.1", "brake": "0.2"}
# What the telemetry holds afterwards, by how many of the fields of GOOD were applied.
HELD = (
    ("5.0000", "0.5000", "0.2500"),
    ("-3.0000", "0.5000", "0.2500"),
    ("-3.0000", "0.1000", "0.2500"),
    ("-3.0000", "0.1000", "0.2000"),
)


@cache
def hall_of(*samples: tuple[float, float]) -> World:
    points = np.array(samples, float).reshape(-1, 2)
    return World("hall", HALL, points, Pose(100, 100, 0))


def simulation_of(*samples: tuple[float, float]) -> Simulation:
    return Simulation(hall_of(*samples), 0, 2)


def held(simulation: Simulation) -> tuple[str, str, str]:
    telemetry = simulation.telemetry()
    return telemetry["steering_angle"], telemetry["throttle"], telemetry["brake"]
