"""ROCK_APPROACH: drives to a rock by sight, slower the nearer."""

from __future__ import annotations

import math

from rover_decision.missions.sample_return.chart import Event
from rover_decision.missions.sample_return.completion import Completion
from rover_decision.missions.sample_return.states.moving import Moving
from rover_decision.missions.sample_return.tick import TickContext
from rover_decision.trouble import MOTION, Limits
from rover_decision.types import Action
from rover_navigation.actuation import Actuation, approach_speed

# of the limit elsewhere: samples stand on the bases of walls too, and one creeps there
TILT_FACTOR = 1.5
CREEP = 0.6  # [m/s] beside a rock: slow enough to keep the camera level
SPEED_MAX = 2.0  # [m/s]
ASIDE = math.radians(25.0)  # a rock further aside is turned to in place
SHORT_OF = 0.5  # [m] before the arm's reach, to stop in
PAST = 0.3  # [m] beyond the arm's reach
LOST_BEYOND = 2.0  # times the range within which a rock is driven to


class RockApproach(Moving):
    def __init__(
        self, limits: Limits, completion: Completion, actuation: Actuation, rock_range: float
    ) -> None:
        """rock_range: [m] within which a rock is driven to by sight."""
        super().__init__(limits, MOTION, TILT_FACTOR)
        self._completion = completion
        self._actuation = actuation
        self._rock_range = rock_range

    def _own_event(self, tick: TickContext) -> Event | None:
        if tick.rock is None or tick.rock.distance > LOST_BEYOND * self._rock_range:
            return Event.rock_lost
        return Event.finished if self._completion.reached(tick) else None

    def act(self, tick: TickContext) -> Action:
        """Drive so that the rock comes to lie where the arm reaches."""
        if tick.rock is None:
            return self._actuation.stop(), "the rock is gone"
        if tick.frame.vehicle.near_sample:
            return self._actuation.stop(), "the rock is in reach: stops"
        reach = self._actuation.vehicle.arm_forward
        distance, bearing = tick.rock.distance, tick.rock.bearing
        if abs(bearing) > ASIDE:
            if distance < reach:
                return self._actuation.reverse(), "too close beside the rock: backs up"
            return self._actuation.turn_in_place(tick.speed, bearing), "turns to the rock"
        short = distance - reach
        if short < -PAST:
            return self._actuation.reverse(), "past the rock: backs up"
        speed = max(CREEP, min(SPEED_MAX, approach_speed(short - SHORT_OF)))
        return self._actuation.drive(tick.speed, speed, bearing), "drives to the rock"
