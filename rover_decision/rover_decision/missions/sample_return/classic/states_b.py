"""The states of classic B."""

from __future__ import annotations

import math

from rover_common.geometry import Pose, distance_between
from rover_common.types import Command
from rover_decision.missions.sample_return.chart import Event, State
from rover_decision.missions.sample_return.classic import rules_b as rules
from rover_decision.missions.sample_return.classic.commands import coast, stop
from rover_decision.missions.sample_return.classic.ground import Ground
from rover_decision.missions.sample_return.classic.homing import HOME_RADIUS, Homing
from rover_decision.missions.sample_return.classic.memory_b import Occasions, TravelCheck
from rover_decision.missions.sample_return.classic.wishes import VisitedGround, left_turn
from rover_decision.missions.sample_return.config import DecisionConfig
from rover_decision.missions.sample_return.parts import Parts
from rover_decision.missions.sample_return.tick import StateBehavior, TickContext
from rover_decision.types import Action


class MemoryB:
    """What all states of B know and share."""

    def __init__(self, parts: Parts, homing: Homing, config: DecisionConfig) -> None:
        self.parts = parts
        self.homing = homing
        self.config = config
        self.occasions = Occasions()
        self.travel = TravelCheck()
        self.steering = 0.0  # [rad] commanded last
        self._visited = VisitedGround()

    def observe(self, tick: TickContext, state: State) -> None:
        """Once per frame, before anything is decided."""
        occasions, time = self.occasions, tick.time
        self.travel.update(time, tick.pose)
        occasions.steered(time, self.steering)
        if state is State.STOP:
            occasions.stop = time
        elif state is State.STUCK:
            occasions.stuck = time
        elif state is State.PICKUP:
            occasions.pickup = time
        self._visited.visit(tick.pose)
        self.homing.update(tick)

    def commanded(self, tick: TickContext, command: Command) -> None:
        """Once per frame, after it."""
        self.steering = command.steering_angle

    def view(self, tick: TickContext) -> rules.View:
        ground = Ground.of(tick.frame.nav, self.config.nav_cell)
        near = ground.within(rules.NAV_RANGE)
        avoidance = self.config.avoid_visited
        weights = self._visited.weights(near, tick.pose, avoidance) if avoidance else None
        return rules.View(ground, near, weights)

    def complete(self, tick: TickContext) -> bool:
        """Whether to go home now."""
        return self.parts.completion.classic(tick)


class DrivingB(StateBehavior):
    """Being stuck first, then a circle, then what concerns the state itself."""

    def __init__(self, memory: MemoryB) -> None:
        self._memory = memory

    def event(self, tick: TickContext) -> Event | None:
        if tick.frame.vehicle.picking_up:
            return Event.rock_reached
        occasions = self._memory.occasions
        if self._memory.travel.stands and occasions.may_be_stuck(tick.time):
            return Event.stopped_moving
        if occasions.circles(tick.time) and not tick.heading_home:
            return Event.circling
        return self._own_event(tick)

    def _own_event(self, tick: TickContext) -> Event | None:
        """What else may happen in this state."""
        return None

    def _rock_event(self, tick: TickContext) -> Event | None:
        seen = rules.nearest_rock(tick.frame.rock) is not None
        return Event.rock_seen if seen and not tick.return_requested else None


class ForwardB(DrivingB):
    """Along the left wall."""

    _turns_since: float | None = None  # [s] after a pickup

    def enter(self, tick: TickContext, before: State) -> None:
        turns = before is State.PICKUP and self._memory.config.turn_after_pickup
        self._turns_since = tick.time if turns else None

    def _own_event(self, tick: TickContext) -> Event | None:
        if self._memory.complete(tick):
            return Event.finished
        if self._left_turn(tick) is not None:
            return None
        blocked = rules.is_blocked(self._memory.view(tick))
        return Event.blocked if blocked else self._rock_event(tick)

    def act(self, tick: TickContext) -> Action:
        turn = self._left_turn(tick)
        if turn is not None:
            return turn, "turns left after the pickup"
        view = self._memory.view(tick)
        return rules.careful_drive(view, tick.speed, rules.EXPLORING), "follows the wall"

    def _left_turn(self, tick: TickContext) -> Command | None:
        return None if self._turns_since is None else left_turn(tick.time - self._turns_since)


class StopB(DrivingB):
    """Brakes, then turns right in place."""

    def _own_event(self, tick: TickContext) -> Event | None:
        if self._memory.complete(tick):
            return Event.finished
        clear = tick.speed <= rules.STOP_SPEED and rules.is_clear(self._memory.view(tick))
        return Event.cleared if clear else None

    def act(self, tick: TickContext) -> Action:
        return stop_and_turn(tick.speed)


class CircleB(DrivingB):
    """Brakes once, then the mean bearing without a bias."""

    def _own_event(self, tick: TickContext) -> Event | None:
        if self._memory.complete(tick):
            return Event.finished
        if tick.since >= rules.OUT_OF_CIRCLE_SECONDS:
            return Event.recovered
        return self._rock_event(tick)

    def act(self, tick: TickContext) -> Action:
        if tick.since == 0.0:
            return stop(), "drives in a circle: brakes"
        view = self._memory.view(tick)
        return rules.careful_drive(view, tick.speed, rules.OUT_OF_CIRCLE), "leaves the circle"


class RockApproachB(DrivingB):
    """Brakes once, then rolls to the nearest rock cell."""

    def _own_event(self, tick: TickContext) -> Event | None:
        return Event.rock_reached if tick.frame.vehicle.near_sample else None

    def act(self, tick: TickContext) -> Action:
        if tick.since == 0.0:
            return stop(), "sees a rock: brakes"
        bearing = rules.nearest_rock(tick.frame.rock)
        if bearing is None:
            return coast(self._memory.steering), "rolls to where the rock was"
        return rules.to_rock(bearing, tick.speed), "rolls to the rock"


class StuckB(DrivingB):
    """The manoeuvre of 13 s, until it has come away from the place."""

    _place: Pose | None = None

    def enter(self, tick: TickContext, before: State) -> None:
        self.recoveries += 1
        self._place = tick.pose

    def event(self, tick: TickContext) -> Event | None:
        assert self._place is not None
        away = distance_between(self._place, tick.pose) >= rules.CLEAR_DISTANCE
        return Event.recovered if away and tick.since >= rules.MANOEUVRE else None

    def act(self, tick: TickContext) -> Action:
        if tick.since == 0.0:
            return stop(), "stuck: brakes"
        return rules.unstuck(self._memory.view(tick), tick.speed, tick.since), "stuck: gets out"


class ReturnHomeB(DrivingB):
    """Towards home, with the same care; stops and turns where there is too little ground."""

    _stopped = False

    def enter(self, tick: TickContext, before: State) -> None:
        self._stopped = False

    def update(self, tick: TickContext) -> None:
        view = self._memory.view(tick)
        clear = tick.speed <= rules.STOP_SPEED and rules.is_clear(view)
        self._stopped = not clear if self._stopped else rules.is_blocked(view)

    def _own_event(self, tick: TickContext) -> Event | None:
        distance = math.dist(self._memory.parts.home, (tick.pose.x, tick.pose.y))
        return Event.arrived if distance <= HOME_RADIUS else self._rock_event(tick)

    def act(self, tick: TickContext) -> Action:
        if self._stopped:
            return stop_and_turn(tick.speed)
        bearing = self._memory.homing.bearing(tick)
        name = self._memory.parts.home_paths.method.name
        view = self._memory.view(tick)
        command = rules.careful_drive(view, tick.speed, rules.HOMEWARD, bearing)
        return command, f"goes home by {name}"


def stop_and_turn(speed: float) -> Action:
    """Where there is too little ground."""
    if speed > rules.STOP_SPEED:
        return stop(), "too little ground ahead: stops"
    return rules.turn_right(), "turns to find ground"
