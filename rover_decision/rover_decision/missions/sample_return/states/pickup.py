"""PICKUP: stands, asks for the pickup until it shows, and waits for the arm."""

from __future__ import annotations

from rover_common.types import SAFE_COMMAND, Command
from rover_decision.missions.sample_return.chart import Event, State
from rover_decision.missions.sample_return.tick import StateBehavior, TickContext
from rover_decision.types import Action

START_SECONDS = 4.0  # [s] for a pickup to show in the telemetry after it was asked for


class Pickup(StateBehavior):
    def __init__(self, standing_speed: float, brake: Command = SAFE_COMMAND) -> None:
        """standing_speed: [m/s] below which the rover stands; brake: with what it stops."""
        self._standing_speed = standing_speed
        self._brake = brake
        self._arm_worked = False

    def enter(self, tick: TickContext, before: State) -> None:
        self._arm_worked = False

    def update(self, tick: TickContext) -> None:
        self._arm_worked |= tick.frame.vehicle.picking_up

    def event(self, tick: TickContext) -> Event | None:
        if tick.frame.vehicle.picking_up:
            return None
        if self._arm_worked:
            return Event.picked_up
        return Event.pickup_failed if tick.since > START_SECONDS else None

    def act(self, tick: TickContext) -> Action:
        vehicle = tick.frame.vehicle
        if vehicle.picking_up:
            return SAFE_COMMAND, "the arm works"
        if not vehicle.near_sample:
            return SAFE_COMMAND, "waits for the arm"
        if abs(vehicle.speed) > self._standing_speed:
            return self._brake, "stops for the pickup"
        return Command(brake=1.0, pickup=True), "picks up"
