"""The telemetries of the active client that wait for their answer: each gets exactly one.

A telemetry is a request of the simulator, a drive command or a pickup the response to it.
"""

from __future__ import annotations

from dataclasses import dataclass

from rover_bridge.counters import Counter
from rover_common.types import SAFE_COMMAND, Command, Telemetry
from rover_common.vehicle import ROVER

# Telemetries that may pass before a pickup that was sent must show: twice the pending requests.
PICKUP_TELEMETRIES = 6
# A simulator has two or three requests pending; more are answered with the brake at once.
MAX_PENDING = 8


@dataclass(frozen=True)
class PendingRequest:
    """One telemetry that waits for its answer."""

    client: str
    stamp: int  # [ns] of the telemetry, unique
    arrived: float  # [s] wall time
    speed: float  # [m/s]
    near_sample: bool
    picking_up: bool

    @classmethod
    def of(cls, client: str, stamp: int, arrived: float, telemetry: Telemetry) -> PendingRequest:
        """That of a telemetry."""
        return cls(
            client,
            stamp,
            arrived,
            telemetry.speed,
            telemetry.near_sample,
            telemetry.picking_up,
        )

    @property
    def allows_pickup(self) -> bool:
        """Whether a sample is in reach, and the rover stands."""
        return self.near_sample and abs(self.speed) <= ROVER.pickup_speed


@dataclass(frozen=True)
class Answer:
    """What to send to which client."""

    client: str
    command: Command
    counter: str  # in which it is counted


class PendingRequests:
    """The pending requests of the active client."""

    def __init__(self, deadline: float) -> None:
        """deadline: [s] of wall time after which a telemetry is answered with the safe brake."""
        self._deadline = deadline
        self._pending: dict[int, PendingRequest] = {}
        self._pickup = _PickupState()

    @property
    def full(self) -> bool:
        """Whether more are pending than any simulator sends."""
        return len(self._pending) >= MAX_PENDING

    @property
    def empty(self) -> bool:
        """Whether the active client has all its answers."""
        return not self._pending

    def clear(self) -> None:
        """The active client has left, or another one took over: nothing is owed to it."""
        self._pending.clear()
        self._pickup = _PickupState()

    def add(self, request: PendingRequest) -> None:
        """A telemetry of the active client was published."""
        self._pickup.update(request)
        self._pending[request.stamp] = request

    def answer(self, stamp: int, command: Command) -> Answer | None:
        """The answer to the telemetry of this stamp [ns]; None when it had one already."""
        request = self._pending.pop(stamp, None)
        if request is None:
            return None
        if not command.pickup:
            return Answer(request.client, command, Counter.ANSWERED)
        if request.picking_up or self._pickup.running:
            return Answer(request.client, SAFE_COMMAND, Counter.PICKUP_ALREADY_RUNNING)
        # With no sample in reach the simulator would freeze for good, and a newer telemetry may
        # say that the rover has rolled past it.
        if not (request.allows_pickup and self._pickup.allowed):
            return Answer(request.client, SAFE_COMMAND, Counter.PICKUP_REFUSED)
        self._pickup.start()
        return Answer(request.client, command, Counter.PICKUP_SENT)

    def expire(self, now: float) -> list[Answer]:
        """Safe answers for all telemetries that have waited too long at `now` [s] of wall time."""
        late = [r for r in self._pending.values() if now - r.arrived >= self._deadline]
        for request in late:
            del self._pending[request.stamp]
        return [Answer(r.client, SAFE_COMMAND, Counter.DEADLINE_MISSED) for r in late]


class _PickupState:
    """Whether a pickup runs, was sent but does not show yet, or may be sent."""

    def __init__(self) -> None:
        self._newest: PendingRequest | None = None
        self._sent = False
        self._telemetries_since = 0

    @property
    def running(self) -> bool:
        """A pickup runs, or one was sent."""
        return self._sent or (self._newest is not None and self._newest.picking_up)

    @property
    def allowed(self) -> bool:
        """Whether the newest telemetry allows one."""
        return self._newest is not None and self._newest.allows_pickup

    def start(self) -> None:
        """A pickup is sent."""
        self._sent, self._telemetries_since = True, 0

    def update(self, request: PendingRequest) -> None:
        """Note a telemetry; once one shows the pickup, telemetries alone tell whether it runs."""
        self._newest = request
        self._telemetries_since += 1
        if request.picking_up or self._telemetries_since >= PICKUP_TELEMETRIES:
            self._sent = False
