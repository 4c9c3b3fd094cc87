"""INITIALIZING: stands; measures level and air, and waits for all inputs."""

from __future__ import annotations

import math

from rover_heat.mission.chart import Event, State
from rover_heat.mission.parts import HeatParts
from rover_heat.mission.tick import HeatAction, HeatBehavior, HeatTick
from rover_heat.thermal.sensing import SENSORS
from rover_heat.tilt import REST

MEASURE = REST * 1e-9  # [s] at rest
STILL_SPEED, STILL_TURN = 0.01, 0.05  # [m/s], [rad/s]
SAYS = 5.0  # [s] between two lines that say what is missing
THERMAL_DEADLINE, DEADLINE = 20.0, 60.0  # [s]


class Initializing(HeatBehavior):
    def __init__(self, parts: HeatParts) -> None:
        self._parts = parts
        self._rest_since = math.inf  # [s]
        self._said = -math.inf  # [s]

    def enter(self, tick: HeatTick, before: State) -> None:
        self._rest_since = math.inf

    def update(self, tick: HeatTick) -> None:
        parts, twist = self._parts, tick.frame.twist
        still = abs(twist.linear) < STILL_SPEED and abs(twist.angular) < STILL_TURN
        if not still:
            self._rest_since = math.inf
        elif tick.frame.imus:
            self._rest_since = min(self._rest_since, tick.time)
        if tick.time - self._rest_since >= MEASURE and not parts.tilt.measured:
            parts.tilt.set_level(tick.frame.stamp)
        missing = self._missing(tick)
        if missing and tick.time - self._said >= SAYS:
            self._said = tick.time
            parts.notices.append(f"waits for {', '.join(missing)}")
        if not self._missing_but_thermal(tick):
            parts.plan_since = tick.time
            self._warn(tick)

    def event(self, tick: HeatTick) -> Event | None:
        needed = self._missing_but_thermal(tick)
        if needed:
            return Event.gave_up if tick.since > DEADLINE else None
        if self._missing(tick) and tick.since <= THERMAL_DEADLINE:
            return None
        return Event.ready

    def act(self, tick: HeatTick) -> HeatAction:
        missing = self._missing(tick)
        if missing:
            return HeatAction(f"waits for {', '.join(missing)}")
        return HeatAction("all inputs are there")

    def _missing(self, tick: HeatTick) -> list[str]:
        alive = self._parts.sensing.alive
        silent = [f"thermal sensor {number}" for number in SENSORS if number not in alive]
        return self._missing_but_thermal(tick) + silent

    def _missing_but_thermal(self, tick: HeatTick) -> list[str]:
        parts, frame = self._parts, tick.frame
        there = {
            "map": frame.grid is not None,
            "pose": frame.pose is not None,
            "navigator": parts.navigator.is_ready,
            "scan": "scan" not in parts.inputs.missing,
            "level": parts.tilt.measured,
            "launcher": frame.time >= parts.launcher_works_until,
        }
        return [name for name, is_there in there.items() if not is_there]

    def _warn(self, tick: HeatTick) -> None:
        """Once, when all that is needed has come: how it begins, and without which sensor."""
        missing = self._missing(tick)
        if self.event(tick) is Event.ready:
            yaw = math.degrees(tick.pose.yaw)
            self._parts.notices.append(f"begins at {yaw:.0f} degrees of the map")
            if missing:
                self._parts.notices.append(f"warning: goes on without {', '.join(missing)}")
