"""The states of classic A."""

from __future__ import annotations

import math

from rover_common.types import Command
from rover_decision.missions.sample_return.chart import Event, State
from rover_decision.missions.sample_return.classic import rules_a as rules
from rover_decision.missions.sample_return.classic.commands import clipped, stop
from rover_decision.missions.sample_return.classic.ground import Ground
from rover_decision.missions.sample_return.classic.homing import HOME_RADIUS, Homing
from rover_decision.missions.sample_return.classic.memory_a import (
    PUSH_SECONDS,
    PositionMemory,
    PushTimer,
)
from rover_decision.missions.sample_return.parts import Parts
from rover_decision.missions.sample_return.tick import StateBehavior, TickContext
from rover_decision.types import Action


class MemoryA:
    """What all states of A know and share."""

    def __init__(self, parts: Parts, homing: Homing, cell: float) -> None:
        """cell: [m] edge of the cells in the polar array of navigable ground."""
        self.parts = parts
        self.homing = homing
        self.positions = PositionMemory()
        self.push = PushTimer()
        self.steering = 0.0  # [rad] commanded last
        self._cell = cell

    def observe(self, tick: TickContext, state: State) -> None:
        """Once per frame, before anything is decided."""
        self.positions.add(tick.pose)
        self.push.update(tick.time)
        self.homing.update(tick)

    def commanded(self, tick: TickContext, command: Command) -> None:
        """Once per frame, after it."""
        self.steering = command.steering_angle

    def ground(self, tick: TickContext) -> Ground:
        return Ground.of(tick.frame.nav, self._cell)

    def complete(self, tick: TickContext) -> bool:
        """Whether to go home now."""
        return self.parts.completion.classic(tick)


class DrivingA(StateBehavior):
    """The push first, then being stuck, then a sample in reach, then rocks, then the state."""

    def __init__(self, memory: MemoryA) -> None:
        self._memory = memory

    def event(self, tick: TickContext) -> Event | None:
        if tick.frame.vehicle.picking_up:
            return Event.rock_reached
        if self._memory.push.due(tick.time):
            return Event.circling
        return self._stuck_event() or self._rock_event(tick) or self._own_event(tick)

    def _stuck_event(self) -> Event | None:
        return Event.stopped_moving if self._memory.positions.stuck else None

    def _rock_event(self, tick: TickContext) -> Event | None:
        if tick.frame.vehicle.near_sample:
            return Event.rock_reached
        seen = len(tick.frame.rock.bearings) > 0
        return Event.rock_seen if seen and not tick.return_requested else None

    def _own_event(self, tick: TickContext) -> Event | None:
        """What else may happen in this state."""
        return None


class ForwardA(DrivingA):
    """Along the left wall."""

    def enter(self, tick: TickContext, before: State) -> None:
        if before is State.STOP:  # it may still roll back, with the steering held
            self._memory.steering = clipped(self._memory.ground(tick).mean_bearing())

    def _own_event(self, tick: TickContext) -> Event | None:
        if self._memory.complete(tick):
            return Event.finished
        return Event.blocked if rules.is_blocked(self._memory.ground(tick)) else None

    def act(self, tick: TickContext) -> Action:
        ground = self._memory.ground(tick)
        return rules.follow_wall(ground, tick.speed, self._memory.steering), "follows the wall"


class StopA(DrivingA):
    """Brakes, then backs out in a three-point turn."""

    def _own_event(self, tick: TickContext) -> Event | None:
        if self._memory.complete(tick):
            return Event.finished
        clear = tick.speed <= rules.STOP_SPEED and rules.is_clear(self._memory.ground(tick))
        return Event.cleared if clear else None

    def act(self, tick: TickContext) -> Action:
        if tick.speed > rules.STOP_SPEED:
            return stop(), "too little ground ahead: stops"
        return rules.three_point_turn(self._memory.ground(tick)), "backs out in a turn"


class RockApproachA(DrivingA):
    """Slowly to the rock."""

    def _rock_event(self, tick: TickContext) -> Event | None:
        if tick.frame.vehicle.near_sample:
            return Event.rock_reached
        return None if len(tick.frame.rock.bearings) else Event.rock_lost

    def act(self, tick: TickContext) -> Action:
        if len(tick.frame.rock.bearings) == 0:
            return stop(), "the rock is gone"
        return rules.to_rock(tick.frame.rock, tick.speed), "drives to the rock"


class StuckA(DrivingA):
    """Nothing moves: hard back, the wheels turned."""

    def enter(self, tick: TickContext, before: State) -> None:
        self.recoveries += 1
        self._memory.positions.clear()

    def _stuck_event(self) -> Event | None:
        return Event.recovered if self._memory.positions.free else None

    def act(self, tick: TickContext) -> Action:
        return rules.back_out(), "stuck: backs out"


class PushA(DrivingA):
    """Straight ahead for a second."""

    def enter(self, tick: TickContext, before: State) -> None:
        self._memory.push.pushed(tick.time)

    def event(self, tick: TickContext) -> Event | None:
        return Event.recovered if tick.since >= PUSH_SECONDS else None

    def act(self, tick: TickContext) -> Action:
        return rules.push(), "pushes straight ahead"


class ReturnHomeA(DrivingA):
    """Back along the breadcrumbs."""

    def _own_event(self, tick: TickContext) -> Event | None:
        distance = math.dist(self._memory.parts.home, (tick.pose.x, tick.pose.y))
        return Event.arrived if distance < HOME_RADIUS else None

    def act(self, tick: TickContext) -> Action:
        bearing = self._memory.homing.bearing(tick)
        name = self._memory.parts.home_paths.method.name
        command = rules.homeward(self._memory.ground(tick), tick.speed, bearing)
        return command, f"goes home by {name}"
