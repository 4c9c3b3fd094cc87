"""The mission: what happened, what follows from it, and what to do; one tick per frame."""

from __future__ import annotations

import math

from rover_common.types import SAFE_COMMAND, Command
from rover_decision import behaviours
from rover_decision.config import DecisionConfig
from rover_decision.events import PLANS_UNPLACED, Situation, what_happened
from rover_decision.home import BREADCRUMBS, WayHome, bearing_home
from rover_decision.memory import Memory
from rover_decision.rocks import Target
from rover_decision.states import Event, Machine, State
from rover_decision.types import Decision, Snapshot
from rover_navigation import recovery
from rover_navigation.local_clearance import Terrain
from rover_navigation.plan_scheduler import MakeRequest

RESTART_SECONDS = 5.0  # [s] of time falling back: a new run has begun
TILT_AHEAD, TILT_RADIUS = 0.6, 0.5  # [m] where it tilted, for good
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
        self._heading_home = False  # once true, recoveries and pickups lead back to it
        self._side = 1  # of the next turn away from an obstacle, +1 left
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
        if self._memory is not None and snapshot.time < self._memory.time - RESTART_SECONDS:
            self.reset()
        if self._memory is None:
            self._memory = Memory(self._config, snapshot)
        memory = self._memory
        memory.update(snapshot, self.state in (State.RETURN_HOME, State.DONE))
        terrain = Terrain.of(snapshot.scan, self._config.corridor)
        self._notice_entry(snapshot, terrain, memory)  # a person's request came between
        if self.state in APPROACHING_STATES:
            memory.approach(snapshot)
        target = memory.target(snapshot)
        self._handle_events(snapshot, terrain, target, memory)
        self._notice_entry(snapshot, terrain, memory)
        command, reason = self._act(snapshot, terrain, target, memory)
        driving = self.state is State.FORWARD and abs(snapshot.vehicle.speed) > 0.3
        memory.circle.update(snapshot.time, command.steering_angle, driving)
        memory.held.update(snapshot.time, snapshot.vehicle.pose, command)
        return Decision(command, self.state, reason, memory.report(snapshot))

    def _handle_events(
        self, snapshot: Snapshot, terrain: Terrain, target: Target | None, memory: Memory
    ) -> None:
        situation = Situation(
            state=self.state,
            since=snapshot.time - self._entered,
            heading_home=self._heading_home,
            time_limit=self._time_limit,
            snapshot=snapshot,
            terrain=terrain,
            target=target,
            memory=memory,
        )
        event = what_happened(situation, self._config)
        if event is not None:
            self._machine.handle(event)
        if event in (Event.finished, Event.gave_up):
            self._heading_home = True

    def _notice_entry(self, snapshot: Snapshot, terrain: Terrain, memory: Memory) -> None:
        """Do what a new state begins with."""
        before, self._noticed = self._noticed, self.state
        if before is self.state:
            return
        self._entered = snapshot.time
        memory.progress.restart()
        memory.held.restart(snapshot.time)
        if {before, self.state} - EXPLORING_STATES:  # between those it may go to and fro for ever
            memory.travel.restart()
        pose = snapshot.vehicle.pose
        match self.state:
            case State.STOP:
                self._side = terrain.roomier_side()
                memory.stopped(snapshot.time, pose)
            case State.PICKUP:
                memory.arm_worked = False
            case State.STUCK:
                if before is State.RETURN_HOME:
                    self._home.trouble()
                memory.recoveries += 1
                memory.ladder.climb(pose, terrain.roomier_side())
                if memory.goals.unplaced >= PLANS_UNPLACED:
                    memory.unblock()  # perhaps that is what shuts it in
                else:
                    memory.block_ahead(snapshot.time, pose)
                memory.goals.await_plans()
            case State.TILT:
                memory.recoveries += 1
                memory.safe_pose = memory.safe_poses.target(pose)
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
                return memory.ladder.command(vehicle.speed, since)
            case State.TILT:
                command = recovery.back_to(memory.safe_pose, vehicle.pose, vehicle.speed)
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
