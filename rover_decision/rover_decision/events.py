"""What happened, seen from one frame: the first event that applies, the most urgent first."""

from __future__ import annotations

import math
from dataclasses import dataclass

from rover_decision import behaviours
from rover_decision.behaviours import WAY_AHEAD, looks_at_goal, wanted_bearing
from rover_decision.config import DecisionConfig
from rover_decision.explore import WALL_FOLLOWERS
from rover_decision.memory import Memory
from rover_decision.rocks import Target
from rover_decision.states import Event, State
from rover_decision.types import Snapshot
from rover_navigation import actuation as motion
from rover_navigation import recovery
from rover_navigation.local_clearance import Terrain

PICKUP_START_SECONDS = 4.0  # [s] for a pickup to show in the telemetry after it was asked for
CIRCLE_SECONDS = 10.0  # [s] of following the mean bearing
STOP_SECONDS = 8.0  # [s] of looking for a way, after which the rover counts as stuck
GAP_SECONDS = 1.0  # [s] between two frames: the rover drove blindly
JUMP = 3.0  # [m] between two frames: somebody has moved it
PLANS_WITHOUT_GOAL = 12  # in a row, while looking around: nothing is left
PLANS_UNPLACED = 20  # in a row: turning on the spot brings neither ground to plan on nor a way out
HOME_RESERVE = 1.3  # of the time estimated for the way home
HOME_EXTRA = 30.0  # [s]
SLOW = 1.0  # [m/s] from which it stops within 0.2 m, so that the sample stays in reach
MOVING_STATES = (
    State.FORWARD, State.STOP, State.CIRCLE, State.ROCK_APPROACH, State.RETURN_HOME,
)  # fmt: skip


@dataclass(frozen=True)
class Situation:
    """A frame, and how the mission stands at it."""

    state: State
    since: float  # [s] in this state
    heading_home: bool
    time_limit: float  # [s] of the mission
    snapshot: Snapshot
    terrain: Terrain
    target: Target | None  # the nearest rock worth going for
    memory: Memory


def what_happened(now: Situation, config: DecisionConfig) -> Event | None:
    """The event for the state machine, None when all goes on as it is."""
    match now.state:
        case State.IDLE:
            return Event.start
        case State.PICKUP:
            return _pickup_event(now)
        case State.STUCK:
            return _stuck_event(now)
        case State.TILT:
            back = recovery.is_back(now.memory.safe_pose, now.snapshot.vehicle.pose)
            return Event.recovered if back or now.since > recovery.TILT_DEADLINE else None
    if now.state not in MOVING_STATES:
        return None
    return _trouble(now, config) or _rock_event(now, config) or _way_event(now, config)


def _pickup_event(now: Situation) -> Event | None:
    if now.snapshot.vehicle.picking_up:
        return None
    if now.memory.arm_worked:
        return Event.picked_up
    return Event.pickup_failed if now.since > PICKUP_START_SECONDS else None


def _stuck_event(now: Situation) -> Event | None:
    ladder = now.memory.ladder
    if ladder.exhausted and not now.heading_home:
        return Event.gave_up
    return Event.recovered if now.since > ladder.rung.seconds else None


def _trouble(now: Situation, config: DecisionConfig) -> Event | None:
    memory, pose = now.memory, now.snapshot.vehicle.pose
    approaches = now.state is State.ROCK_APPROACH
    limit = config.tilt_limit * (recovery.APPROACH_TILT if approaches else 1.0)
    if max(abs(pose.pitch), abs(pose.roll)) > limit:
        return Event.tilted
    if memory.gap > GAP_SECONDS or memory.jump > JUMP:
        return Event.lost
    if now.state is State.STOP and now.since > STOP_SECONDS:
        return Event.stopped_moving
    time = now.snapshot.time
    if memory.held.held(time) or memory.progress.stuck() or memory.travel.stuck():
        return Event.stopped_moving
    if now.state is State.FORWARD:
        if memory.goals.unplaced >= PLANS_UNPLACED:
            return Event.stopped_moving
        if memory.circle.circling(time):
            return Event.circling
    return None


def _rock_event(now: Situation, config: DecisionConfig) -> Event | None:
    vehicle, target = now.snapshot.vehicle, now.target
    if vehicle.near_sample and not vehicle.picking_up and abs(vehicle.speed) < SLOW:
        return Event.rock_reached
    if now.state is not State.ROCK_APPROACH:
        near = target is not None and target.distance < config.rock_range
        return Event.rock_seen if near and not now.heading_home else None
    if target is None or target.distance > 2.0 * config.rock_range:
        return Event.rock_lost
    return None


def _way_event(now: Situation, config: DecisionConfig) -> Event | None:
    if now.state is State.RETURN_HOME:
        arrived = now.memory.home_distance(now.snapshot.vehicle.pose) < config.home_radius
        return Event.arrived if arrived else None
    if now.heading_home or _finished(now, config):
        return Event.finished
    if now.state is State.CIRCLE and now.since > CIRCLE_SECONDS:
        return Event.recovered
    if now.state in (State.FORWARD, State.CIRCLE):
        return Event.blocked if _blocked(now, config) else None
    return Event.cleared if _cleared(now, config) else None


def _blocked(now: Situation, config: DecisionConfig) -> bool:
    """Whether there is too little way ahead; none is needed to turn on the spot."""
    wanted = wanted_bearing(now.snapshot, config)
    if abs(wanted) > math.radians(40.0) or looks_at_goal(now.snapshot, config):
        return False
    braking = motion.braking_distance(now.snapshot.vehicle.speed)
    return now.terrain.clearance(wanted / 2) < config.stop_clearance + braking


def _cleared(now: Situation, config: DecisionConfig) -> bool:
    plan = now.snapshot.plan
    if now.state is not State.STOP:
        return False
    if config.explorer in WALL_FOLLOWERS or plan is None:
        way = now.terrain.way(config.go_clearance)
        return way is not None and abs(way) < WAY_AHEAD
    if plan.goal is None:
        return now.since > 1.0  # FORWARD looks around
    wanted = wanted_bearing(now.snapshot, config)
    aligned = now.since > 0.5 and abs(wanted) < WAY_AHEAD
    return aligned and behaviours.has_room(now.terrain, wanted, config)


def _finished(now: Situation, config: DecisionConfig) -> bool:
    memory, snapshot, plan = now.memory, now.snapshot, now.snapshot.plan
    home_seconds = 0.0
    if plan is not None and math.isfinite(plan.home_seconds):
        home_seconds = HOME_RESERVE * plan.home_seconds + HOME_EXTRA
    if memory.elapsed(snapshot) + home_seconds > now.time_limit:
        return True
    if config.explorer in WALL_FOLLOWERS and memory.all_collected(snapshot):
        return True
    explored = plan is not None and memory.goals.missing >= PLANS_WITHOUT_GOAL
    return explored and not memory.second_look(snapshot)
