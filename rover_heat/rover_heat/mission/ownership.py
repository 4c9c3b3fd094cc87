"""One owner of the velocity at a time: the navigator, or the mission itself."""

from __future__ import annotations

from rover_common.sensor_types import Twist

STOPPED = 0.5  # [s] of zero velocity at each change of the owner

STAND = Twist()


class CommandOwner:
    """At first it is the mission."""

    def __init__(self) -> None:
        self._navigator = False
        self._since = 0.0  # [s] of the last change

    def command(self, time: float, wanted: Twist | None) -> Twist | None:
        """What to send at a time [s]; `wanted` None, and the same as an answer: the navigator."""
        if (wanted is None) is not self._navigator:
            self._navigator, self._since = wanted is None, time
        return STAND if time - self._since < STOPPED else wanted

    def navigator_drives(self, time: float) -> bool:
        """Whether the velocity is the navigator's at a time [s], the stop at the change over."""
        return self._navigator and time - self._since >= STOPPED
