"""What the rover does in each state: a command and a reason out of one snapshot."""

from __future__ import annotations

import math

import numpy as np

from rover_common.dataflow import SAFE_COMMAND, Command
from rover_common.geometry import Pose, wrap_angle
from rover_common.vehicle import ARM_FORWARD, MAX_STEERING
from rover_decision import motion
from rover_decision.config import DecisionConfig
from rover_decision.crumbs import Crumbs
from rover_decision.dataflow import Snapshot
from rover_decision.explore import EXPLORERS
from rover_decision.rocks import Target
from rover_decision.terrain import Terrain

Action = tuple[Command, str]

STANDING = 0.1  # [m/s]
CREEP = 0.5  # [m/s] beside a rock: slow enough to keep the camera level
REACHED = 1.2  # [m] distance at which a point of the way home counts as reached
LOOK_AROUND = math.radians(60.0)  # out of sight, so that the turn goes on
BACK_UP_SECONDS = 2.0  # [s]
TURN_SECONDS = 2.5  # [s]


def explore(snapshot: Snapshot, terrain: Terrain, config: DecisionConfig) -> Action:
    """Follow the walls at the speed that the free way ahead allows."""
    nav = snapshot.nav
    if len(nav.bearings) == 0:
        return motion.stop(), "sees no ground"
    wanted = EXPLORERS[config.explorer](nav)
    bearing = terrain.best_bearing(wanted, config.go_clearance)
    return _drive_towards(snapshot, terrain, bearing, config.top_speed), "follows the wall"


def look_for_a_way(
    snapshot: Snapshot, terrain: Terrain, side: int, config: DecisionConfig
) -> Action:
    """Stop, then turn on the spot to one side (+1 left) until there is a way."""
    if abs(snapshot.vehicle.speed) > STANDING * 2:
        return motion.stop(), "no way ahead: stops"
    way = terrain.way(config.go_clearance)
    bearing = side * LOOK_AROUND if way is None else way
    return motion.turn_in_place(snapshot.vehicle.speed, bearing), "turns to find a way"


def approach(snapshot: Snapshot, target: Target | None) -> Action:
    """Drive to the rock so that it comes to lie where the arm reaches."""
    if target is None:
        return motion.stop(), "the rock is gone"
    speed = snapshot.vehicle.speed
    if snapshot.vehicle.near_sample:
        return motion.stop(), "the rock is in reach: stops"
    short = target.distance - ARM_FORWARD
    if abs(target.bearing) > math.radians(25.0) and target.distance < 3.0:
        if target.distance < 1.2:
            return motion.reverse(0.0), "too close beside the rock: backs up"
        return motion.turn_in_place(speed, target.bearing), "turns to the rock"
    if short < -0.3:
        return motion.reverse(0.0), "past the rock: backs up"
    target_speed = max(CREEP, min(2.0, motion.approach_speed(short - 0.5)))
    return motion.drive(speed, target_speed, target.bearing), "drives to the rock"


def pick_up(snapshot: Snapshot) -> Action:
    """Stand, then ask for the pickup until the simulator says that it runs."""
    vehicle = snapshot.vehicle
    if vehicle.picking_up:
        return SAFE_COMMAND, "the arm works"
    if not vehicle.near_sample:
        return SAFE_COMMAND, "waits for the arm"
    if abs(vehicle.speed) > STANDING:
        return motion.stop(), "stops for the pickup"
    return Command(brake=1.0, pickup=True), "picks up"


def back_off(snapshot: Snapshot, seconds: float, side: int) -> Action:
    """Reverse, then turn on the spot to one side (+1 left): the way out of a corner."""
    if seconds < BACK_UP_SECONDS:
        return motion.reverse(-side * MAX_STEERING), "backs up"
    return (
        motion.turn_in_place(snapshot.vehicle.speed, side * math.radians(60.0)),
        "turns away",
    )


def go_home(
    snapshot: Snapshot, terrain: Terrain, way: np.ndarray, config: DecisionConfig
) -> Action:
    """Follow the points (n, 2) [m] home; the caller drops those that are reached."""
    if len(way) == 0:
        return motion.stop(), "has no way home"
    pose, speed = snapshot.vehicle.pose, snapshot.vehicle.speed
    bearing = bearing_to(pose, way[0])
    if abs(bearing) > math.radians(50.0):
        return motion.turn_in_place(speed, bearing), "turns to the way home"
    distance = float(np.hypot(*(way[0] - (pose.x, pose.y))))
    bearing = terrain.best_bearing(bearing, min(distance, config.go_clearance))
    return _drive_towards(snapshot, terrain, bearing, config.top_speed), "follows its crumbs home"


def remaining_way(way: np.ndarray, pose: Pose) -> np.ndarray:
    """The way without the points already reached."""
    if len(way) == 0:
        return way
    near = np.nonzero(np.hypot(way[:8, 0] - pose.x, way[:8, 1] - pose.y) < REACHED)[0]
    return way[near[-1] + 1 :] if len(near) else way


def plan_home(crumbs: Crumbs, pose: Pose) -> np.ndarray:
    """The way home over the crumbs, (n, 2) [m]."""
    return crumbs.way_home(pose)


def bearing_to(pose: Pose, point: np.ndarray) -> float:
    """[rad] left positive"""
    return wrap_angle(math.atan2(point[1] - pose.y, point[0] - pose.x) - pose.yaw)


def _drive_towards(
    snapshot: Snapshot, terrain: Terrain, bearing: float, top_speed: float
) -> Command:
    """As fast as the free way allows: around a bend, the way is the corridor to its side."""
    ahead = min(terrain.clearance(bearing), terrain.clearance(bearing / 2))
    speed = min(top_speed, motion.approach_speed(ahead - 0.8))
    return motion.drive(snapshot.vehicle.speed, max(0.3, speed), bearing)
