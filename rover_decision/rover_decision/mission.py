"""The mission: what happened, what follows from it, and what to do; one tick per frame."""

from __future__ import annotations

import math

from rover_common.dataflow import SAFE_COMMAND, Command
from rover_common.geometry import Pose
from rover_decision import behaviours, motion, recovery
from rover_decision.behaviours import WAY_AHEAD, looks_at_goal, wanted_bearing
from rover_decision.config import DecisionConfig
from rover_decision.dataflow import Decision, Snapshot
from rover_decision.explore import WALL_FOLLOWERS
from rover_decision.home import BREADCRUMBS, WayHome, bearing_home
from rover_decision.memory import Memory
from rover_decision.planning.desk import MakeRequest
from rover_decision.rocks import Target
from rover_decision.states import Event, Machine, State
from rover_decision.terrain import Terrain

PICKUP_START_SECONDS = 4.0  # [s] for a pickup to show in the telemetry after it was asked for
CIRCLE_SECONDS = 10.0  # [s] of following the mean bearing
STOP_SECONDS = 8.0  # [s] of looking for a way, after which the rover counts as stuck
RESTART_SECONDS = 5.0  # [s] of time falling back: a new run has begun
GAP_SECONDS = 1.0  # [s] between two frames: the rover drove blindly
JUMP = 3.0  # [m] between two frames: somebody has moved it
PLANS_WITHOUT_GOAL = 12  # in a row, while looking around: nothing is left
PLANS_UNPLACED = 20  # in a row: turning on the spot brings neither ground to plan on nor a way out
HOME_RESERVE = 1.3  # of the time estimated for the way home
HOME_EXTRA = 30.0  # [s]
TILT_AHEAD, TILT_RADIUS = 0.6, 0.5  # [m] where it tilted, for good
MOVING_STATES = (
    State.FORWARD, State.STOP, State.CIRCLE, State.ROCK_APPROACH, State.RETURN_HOME,
)  # fmt: skip
# Time goes into a rock in these, also where a recovery interrupts the approach again and again.
APPROACHING_STATES = (State.ROCK_APPROACH, State.TILT, State.STUCK)
EXPLORING_STATES = {State.FORWARD, State.STOP, State.CIRCLE}


class Mission:
    """Holds the machine and what the mission remembers."""

    def __init__(self, config: DecisionConfig) -> None:
        self._config = config
        self.number = 0  # counts the missions, so that one can be told from the next
        self.reset()

    def reset(self) -> None:
        """Forget everything: the next frame starts a new mission."""
        self.number += 1
        self._machine = Machine()
        self._time_limit = self._config.time_limit
        self._memory: Memory | None = None
        self._noticed = self._machine.state
        self._entered = 0.0  # [s] when the state was entered
        self._last: tuple[float, Pose] | None = None  # [s] of the last frame, and its pose
        self._pickup_seen = False
        self._heading_home = False  # once true, recoveries and pickups lead back to it
        self._side = 1  # of the next turn away from an obstacle, +1 left
        self._ladder = recovery.Ladder()
        self._safe_pose: Pose | None = None
        self._home = WayHome(self._config.way_home)

    @property
    def state(self) -> State:
        return self._machine.state

    @property
    def memory(self) -> Memory:
        """What it remembers, from the first frame on."""
        if self._memory is None:
            raise RuntimeError("the mission has not had a frame yet")
        return self._memory

    def start(self) -> bool:
        """Whether a mission that is over starts again."""
        if self.state is not State.DONE:
            return False
        self.reset()
        return True

    def pause(self) -> bool:
        """Whether the mission could be paused."""
        return self._machine.handle(Event.pause)

    def resume(self) -> bool:
        """Whether the mission was paused and goes on."""
        return self._machine.handle(Event.resume)

    def return_home(self) -> bool:
        """Whether the mission turns home: now, or after the pickup, manoeuvre or pause at hand."""
        if self.state is State.DONE:
            return False
        self._machine.handle(Event.finished)
        self._heading_home = True
        return True

    def limit_time(self, seconds: float) -> None:
        """Let this mission be home within so many seconds from its first frame on."""
        self._time_limit = seconds

    def plan_request(self, snapshot: Snapshot) -> MakeRequest:
        """What a plan is to be made of, asked right after the frame's tick."""
        by_crumbs = self._heading_home and self._home.method == BREADCRUMBS
        return self.memory.request(snapshot, by_crumbs)

    def tick(self, snapshot: Snapshot) -> Decision:
        """Decide about one frame."""
        if self._last is not None and snapshot.time < self._last[0] - RESTART_SECONDS:
            self.reset()
        if self._memory is None:
            self._memory = Memory(self._config, snapshot)
        self._memory.update(snapshot, self.state in (State.RETURN_HOME, State.DONE))
        terrain = Terrain.of(snapshot.scan, self._config.corridor)
        self._notice_entry(snapshot, terrain, self._memory)  # a person's request came between
        if self._last is not None and self.state in APPROACHING_STATES:
            self._memory.approach(snapshot, snapshot.time - self._last[0])
        target = self._memory.target(snapshot)
        event = self._what_happened(snapshot, terrain, target, self._memory)
        self._last = (snapshot.time, snapshot.vehicle.pose)
        if event is not None:
            self._machine.handle(event)
        self._notice_entry(snapshot, terrain, self._memory)
        command, reason = self._act(snapshot, terrain, target, self._memory)
        driving = self.state is State.FORWARD and abs(snapshot.vehicle.speed) > 0.3
        self._memory.circle.update(snapshot.time, command.steering_angle, driving)
        self._memory.held.update(snapshot.time, snapshot.vehicle.pose, command)
        return Decision(command, self.state, reason, self._memory.report(snapshot))

    def _what_happened(
        self, snapshot: Snapshot, terrain: Terrain, target: Target | None, memory: Memory
    ) -> Event | None:
        """The first that applies, the most urgent first."""
        state, since = self.state, snapshot.time - self._entered
        if state is State.IDLE:
            return Event.start
        if state is State.PICKUP:
            return self._pickup_event(snapshot, since)
        if state is State.STUCK:
            if self._ladder.exhausted and not self._heading_home:
                self._heading_home = True
                return Event.gave_up
            return Event.recovered if since > self._ladder.rung.seconds else None
        if state is State.TILT:
            back = recovery.is_back(self._safe_pose, snapshot.vehicle.pose)
            return Event.recovered if back or since > recovery.TILT_DEADLINE else None
        if state not in MOVING_STATES:
            return None
        return (
            self._trouble(snapshot, since, memory)
            or self._rock_event(snapshot, target, memory)
            or self._way_event(snapshot, terrain, since, memory)
        )

    def _pickup_event(self, snapshot: Snapshot, since: float) -> Event | None:
        vehicle = snapshot.vehicle
        if vehicle.picking_up:
            self._pickup_seen = True
            return None
        if self._pickup_seen:
            return Event.picked_up
        return Event.pickup_failed if since > PICKUP_START_SECONDS else None

    def _trouble(self, snapshot: Snapshot, since: float, memory: Memory) -> Event | None:
        pose = snapshot.vehicle.pose
        approaches = self.state is State.ROCK_APPROACH
        limit = self._config.tilt_limit * (recovery.APPROACH_TILT if approaches else 1.0)
        if max(abs(pose.pitch), abs(pose.roll)) > limit:
            return Event.tilted
        if self._last is not None:
            time, last = self._last
            jump = math.hypot(pose.x - last.x, pose.y - last.y)
            if snapshot.time - time > GAP_SECONDS or jump > JUMP:
                return Event.lost
        if self.state is State.STOP and since > STOP_SECONDS:
            return Event.stopped_moving
        if memory.held.held(snapshot.time) or memory.progress.stuck() or memory.travel.stuck():
            return Event.stopped_moving
        if self.state is State.FORWARD and memory.goals.unplaced >= PLANS_UNPLACED:
            return Event.stopped_moving
        if self.state is State.FORWARD and memory.circle.circling(snapshot.time):
            return Event.circling
        return None

    def _rock_event(
        self, snapshot: Snapshot, target: Target | None, memory: Memory
    ) -> Event | None:
        vehicle = snapshot.vehicle
        if vehicle.near_sample and not vehicle.picking_up and abs(vehicle.speed) < 1.0:
            return Event.rock_reached
        if self.state is not State.ROCK_APPROACH:
            near = target is not None and target.distance < self._config.rock_range
            return Event.rock_seen if near and not self._heading_home else None
        if target is None or target.distance > 2.0 * self._config.rock_range:
            return Event.rock_lost
        return None

    def _way_event(
        self, snapshot: Snapshot, terrain: Terrain, since: float, memory: Memory
    ) -> Event | None:
        pose = snapshot.vehicle.pose
        if self.state is State.RETURN_HOME:
            arrived = memory.home_distance(pose) < self._config.home_radius
            return Event.arrived if arrived else None
        if self._heading_home or self._finished(snapshot, memory):
            self._heading_home = True
            return Event.finished
        if self.state is State.CIRCLE and since > CIRCLE_SECONDS:
            return Event.recovered
        if self.state in (State.FORWARD, State.CIRCLE):
            wanted = wanted_bearing(snapshot, self._config)
            turning = abs(wanted) > math.radians(40.0) or looks_at_goal(snapshot, self._config)
            needed = self._config.stop_clearance + motion.braking_distance(snapshot.vehicle.speed)
            blocked = terrain.clearance(wanted / 2) < needed
            return Event.blocked if blocked and not turning else None
        return Event.cleared if self._cleared(snapshot, terrain, since) else None

    def _cleared(self, snapshot: Snapshot, terrain: Terrain, since: float) -> bool:
        if self.state is not State.STOP:
            return False
        if self._config.explorer in WALL_FOLLOWERS or snapshot.plan is None:
            way = terrain.way(self._config.go_clearance)
            return way is not None and abs(way) < WAY_AHEAD
        if snapshot.plan.goal is None:
            return since > 1.0  # FORWARD looks around
        wanted = wanted_bearing(snapshot, self._config)
        aligned = since > 0.5 and abs(wanted) < WAY_AHEAD
        return aligned and behaviours.has_room(terrain, wanted, self._config)

    def _finished(self, snapshot: Snapshot, memory: Memory) -> bool:
        plan, follows_walls = snapshot.plan, self._config.explorer in WALL_FOLLOWERS
        home_seconds = 0.0
        if plan is not None and math.isfinite(plan.home_seconds):
            home_seconds = HOME_RESERVE * plan.home_seconds + HOME_EXTRA
        if memory.elapsed(snapshot) + home_seconds > self._time_limit:
            return True
        if follows_walls and memory.all_collected(snapshot):
            return True
        explored = plan is not None and memory.goals.missing >= PLANS_WITHOUT_GOAL
        return explored and not memory.second_look(snapshot)

    def _notice_entry(self, snapshot: Snapshot, terrain: Terrain, memory: Memory) -> None:
        """Do what a new state begins with."""
        before, self._noticed = self._noticed, self.state
        if before is self.state:
            return
        self._entered = snapshot.time
        self._pickup_seen = False
        memory.progress.restart()
        memory.held.restart(snapshot.time)
        if {before, self.state} - EXPLORING_STATES:  # between those it may go to and fro for ever
            memory.travel.restart()
        pose = snapshot.vehicle.pose
        match self.state:
            case State.STOP:
                self._side = terrain.roomier_side()
                memory.stopped(snapshot.time, pose)
            case State.STUCK:
                if before is State.RETURN_HOME:
                    self._home.trouble()
                memory.recoveries += 1
                self._ladder.climb(pose, terrain.roomier_side())
                if memory.goals.unplaced >= PLANS_UNPLACED:
                    memory.unblock()  # perhaps that is what shuts it in
                else:
                    memory.block_ahead(snapshot.time, pose)
                memory.goals.await_plans()
            case State.TILT:
                memory.recoveries += 1
                self._safe_pose = memory.safe_poses.target(pose)
                memory.block(pose, TILT_AHEAD, TILT_RADIUS, math.inf)
            case State.RETURN_HOME:
                self._home.begin(snapshot.time)

    def _act(
        self, snapshot: Snapshot, terrain: Terrain, target: Target | None, memory: Memory
    ) -> tuple[Command, str]:
        vehicle, since = snapshot.vehicle, snapshot.time - self._entered
        match self.state:
            case State.FORWARD:
                return behaviours.explore(snapshot, terrain, self._config)
            case State.STOP:
                return behaviours.look_for_a_way(snapshot, terrain, self._side, self._config)
            case State.CIRCLE:
                return behaviours.leave_the_circle(snapshot, terrain, self._config)
            case State.ROCK_APPROACH:
                return behaviours.approach(snapshot, target)
            case State.PICKUP:
                return behaviours.pick_up(snapshot)
            case State.STUCK:
                return self._ladder.command(vehicle.speed, since)
            case State.TILT:
                command = recovery.back_to(self._safe_pose, vehicle.pose, vehicle.speed)
                return command, "leans too far: backs to level ground"
            case State.RETURN_HOME:
                return self._go_home(snapshot, terrain, memory)
            case State.DONE:
                return SAFE_COMMAND, "the mission is over"
            case State.PAUSED:
                return SAFE_COMMAND, "paused"
            case _:
                return SAFE_COMMAND, "waits for the first frame"

    def _go_home(self, snapshot: Snapshot, terrain: Terrain, memory: Memory) -> tuple[Command, str]:
        pose = snapshot.vehicle.pose
        way = self._home.update(snapshot.time, pose, memory.home, snapshot.plan)
        bearing = bearing_home(snapshot.nav, pose, memory.home) if len(way) == 0 else None
        return behaviours.go_home(snapshot, terrain, way, bearing, self._home.method, self._config)
