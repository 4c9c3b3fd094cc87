"""What the rover does in each state: a command and a reason out of one snapshot."""

from __future__ import annotations

import math

from rover_common.types import SAFE_COMMAND, Command
from rover_common.vehicle import ARM_FORWARD
from rover_decision.config import DecisionConfig
from rover_decision.explore import WALL_FOLLOWERS, mean_bearing
from rover_decision.rocks import Target
from rover_decision.types import Snapshot
from rover_navigation import actuation as motion
from rover_navigation.local_clearance import Terrain
from rover_navigation.path_tracking import at_end, bearing_of, bearing_to, follow
from rover_navigation.types import GoalKind, Way

Action = tuple[Command, str]

STANDING = 0.1  # [m/s]
CREEP = 0.6  # [m/s] beside a rock: slow enough to keep the camera level
ASIDE = math.radians(25.0)  # a rock further aside is turned to on the spot
WAY_AHEAD = math.radians(12.0)  # a way this near to straight ahead can be driven into
ROOM_TO_GO = 1.2  # of the clearance below which it stops, so that it does not stop at once again
LOOK_AROUND = math.radians(60.0)  # out of sight, so that the turn goes on
SLOWEST = 0.3  # [m/s]


def wanted_bearing(snapshot: Snapshot, config: DecisionConfig) -> float:
    """Where the plan leads [rad], or what to look at; straight ahead for who follows walls."""
    plan, pose = snapshot.plan, snapshot.vehicle.pose
    if config.explorer in WALL_FOLLOWERS or plan is None or len(plan.way) == 0:
        return 0.0
    if plan.goal is not None and looks_at_goal(snapshot, config):
        return bearing_to(pose, plan.goal.x, plan.goal.y)
    return bearing_of(pose, plan.way)


def looks_at_goal(snapshot: Snapshot, config: DecisionConfig) -> bool:
    """Whether the rover is where its goal is looked at from; it turns there on the spot."""
    plan, pose = snapshot.plan, snapshot.vehicle.pose
    if config.explorer in WALL_FOLLOWERS or plan is None or plan.goal is None:
        return False
    at_hand = plan.goal.kind is not GoalKind.ROCK and len(plan.way) > 0
    return at_hand and at_end(pose, plan.way)


def explore(snapshot: Snapshot, terrain: Terrain, config: DecisionConfig) -> Action:
    """Drive along the plan, or along the walls."""
    if config.explorer in WALL_FOLLOWERS:
        return follow_the_wall(snapshot, terrain, config)
    plan, vehicle = snapshot.plan, snapshot.vehicle
    if plan is None:
        return motion.stop(), "waits for the first plan"
    if plan.goal is None or len(plan.way) == 0:
        return motion.turn_in_place(vehicle.speed, LOOK_AROUND), "looks around for a goal"
    if looks_at_goal(snapshot, config):
        bearing = wanted_bearing(snapshot, config)
        return motion.turn_in_place(vehicle.speed, bearing), f"looks at {plan.goal.kind.value}"
    command = follow(vehicle.pose, vehicle.speed, plan.way, terrain, config.top_speed)
    return command, f"drives to {plan.goal.kind.value}"


def follow_the_wall(snapshot: Snapshot, terrain: Terrain, config: DecisionConfig) -> Action:
    """By the preset, at the speed that the free way ahead allows."""
    nav = snapshot.nav
    if len(nav.bearings) == 0:
        return motion.stop(), "sees no ground"
    wanted = WALL_FOLLOWERS[config.explorer](nav)
    bearing = terrain.best_bearing(wanted, config.go_clearance)
    return drive_towards(snapshot, terrain, bearing, config.top_speed), "follows the wall"


def leave_the_circle(snapshot: Snapshot, terrain: Terrain, config: DecisionConfig) -> Action:
    """Where the most ground is, whatever the explorer wants."""
    if len(snapshot.nav.bearings) == 0:
        return motion.stop(), "sees no ground"
    bearing = terrain.best_bearing(mean_bearing(snapshot.nav), config.go_clearance)
    return drive_towards(snapshot, terrain, bearing, config.top_speed), "leaves the circle"


def has_room(terrain: Terrain, bearing: float, config: DecisionConfig) -> bool:
    """Whether there is enough free way to set out in this direction [rad]."""
    return terrain.clearance(bearing) > ROOM_TO_GO * config.stop_clearance


def look_for_a_way(
    snapshot: Snapshot, terrain: Terrain, side: int, config: DecisionConfig
) -> Action:
    """Stop, then turn on the spot: along the plan, or to a side (+1 left) until there is a way."""
    vehicle = snapshot.vehicle
    if vehicle.speed > STANDING * 2:
        return motion.stop(), "no way ahead: stops"
    if config.explorer not in WALL_FOLLOWERS and snapshot.plan is not None:
        if len(snapshot.plan.way) == 0:
            return motion.turn_in_place(vehicle.speed, LOOK_AROUND), "turns to find a way"
        bearing = wanted_bearing(snapshot, config)
        if abs(bearing) < WAY_AHEAD and not has_room(terrain, bearing, config):
            return motion.reverse(0.0), "too near for the new way: backs up"
        return motion.turn_in_place(vehicle.speed, bearing), "turns to the new way"
    way = terrain.way(config.go_clearance)
    bearing = side * LOOK_AROUND if way is None else way
    return motion.turn_in_place(vehicle.speed, bearing), "turns to find a way"


def approach(snapshot: Snapshot, target: Target | None) -> Action:
    """Drive to the rock so that it comes to lie where the arm reaches."""
    if target is None:
        return motion.stop(), "the rock is gone"
    speed = snapshot.vehicle.speed
    if snapshot.vehicle.near_sample:
        return motion.stop(), "the rock is in reach: stops"
    short = target.distance - ARM_FORWARD
    if abs(target.bearing) > ASIDE:
        if target.distance < ARM_FORWARD:
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


def go_home(
    snapshot: Snapshot,
    terrain: Terrain,
    way: Way,
    bearing: float | None,
    method: str,
    config: DecisionConfig,
) -> Action:
    """Along the way, or, where there is none, towards the bearing [rad]."""
    vehicle, reason = snapshot.vehicle, f"goes home by {method}"
    if len(way) > 0:
        return follow(vehicle.pose, vehicle.speed, way, terrain, config.top_speed), reason
    if bearing is None:
        return motion.turn_in_place(vehicle.speed, LOOK_AROUND), f"{reason}: looks around"
    if terrain.clearance(bearing) < config.stop_clearance:
        around = terrain.best_bearing(bearing, config.go_clearance)
        turn = around if abs(around) > math.radians(10.0) else LOOK_AROUND
        return motion.turn_in_place(vehicle.speed, turn), f"{reason}: turns"
    return drive_towards(snapshot, terrain, bearing, config.top_speed), reason


def drive_towards(
    snapshot: Snapshot, terrain: Terrain, bearing: float, top_speed: float
) -> Command:
    """As fast as the free way allows: around a bend, the way is the corridor to its side."""
    ahead = min(terrain.clearance(bearing), terrain.clearance(bearing / 2))
    speed = min(top_speed, motion.approach_speed(ahead - 0.8))
    return motion.drive(snapshot.vehicle.speed, max(SLOWEST, speed), bearing)
