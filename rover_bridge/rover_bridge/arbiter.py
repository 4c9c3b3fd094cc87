"""Who drives: a person, a velocity, or the decision node; one of them for each telemetry.

The first of the drivers in this order counts that has been heard within TIMEOUT. Time is that of
the telemetries, so that the rover drives for no more than TIMEOUT of its own time on an old word,
however fast it is simulated.
"""

from __future__ import annotations

from enum import Enum

from rover_common.sensor_types import Twist

TIMEOUT = 0.5  # [s] of telemetries' time


class Driver(Enum):
    """The one to be listened to first comes first."""

    MANUAL = "manual"  # cmd_vel_teleop: a person at the keys
    CMD_VEL = "cmd_vel"  # a navigator, or a teleoperation of somebody else
    DECISION = "decision"  # the decision node
    NOBODY = "nobody"


class Arbiter:
    """Remembers when each driver was heard last, and what velocity it wanted."""

    def __init__(self) -> None:
        self._heard: dict[Driver, float] = {}  # [s]
        self._wanted: dict[Driver, Twist] = {}

    def hear(self, driver: Driver, time: float, wanted: Twist | None = None) -> None:
        """time [s]: of the newest telemetry; wanted: its velocity, of those that drive by one."""
        self._heard[driver] = time
        if wanted is not None:
            self._wanted[driver] = wanted

    def driver(self, time: float) -> Driver:
        """Who drives at a telemetry of this time [s]."""
        for driver in Driver:
            if driver in self._heard and time - self._heard[driver] <= TIMEOUT:
                return driver
        return Driver.NOBODY

    def velocity(self, driver: Driver) -> Twist | None:
        """What it wants; None for a driver that does not drive by a velocity."""
        return self._wanted.get(driver)
