"""Who is owed an answer: every telemetry gets exactly one, decided on it, or safe."""

from __future__ import annotations

from dataclasses import dataclass

from rover_common.types import SAFE_COMMAND, Command
from rover_common.vehicle import ROVER

# Telemetries that may pass before a pickup that was sent must show: the exchanges in flight, twice.
PICKUP_TELEMETRIES = 6
# A simulator has two or three exchanges in flight; one that floods is answered without a look.
MAX_OPEN = 8
# A driver that owes a telemetry for this long is gone: reloading the simulator's scene leaves its
# socket open, and the reloaded simulator comes back on another one.
SILENCE = 2.0  # [s] of wall time


@dataclass(frozen=True)
class Ticket:
    """One telemetry that waits for its answer."""

    client: str
    stamp: int  # [ns] of the telemetry, unique
    arrived: float  # [s] wall time
    speed: float  # [m/s]
    near_sample: bool
    picking_up: bool


@dataclass(frozen=True)
class Answer:
    """What to send to whom."""

    client: str
    command: Command
    why: str  # the counter that it goes under


class Exchange:
    """The open telemetries of the driving client."""

    def __init__(self, deadline: float) -> None:
        """deadline: [s] of wall time after which a telemetry is answered with the safe brake."""
        self._deadline = deadline
        self._open: dict[int, Ticket] = {}
        self._arm = _Arm()
        self._heard = 0.0  # [s] wall time of the driver's latest telemetry
        self.driver: str | None = None

    @property
    def full(self) -> bool:
        """Whether more are open than any simulator has in flight."""
        return len(self._open) >= MAX_OPEN

    def admit(self, client: str, now: float) -> bool:
        """Whether this client, heard at `now` [s] of wall time, drives.

        The first one does, until it leaves, or owes a telemetry while another one sends.
        """
        silent = not self._open and now - self._heard >= SILENCE
        if self.driver is None or (client != self.driver and silent):
            self.driver = client
            self._arm = _Arm()
        if client == self.driver:
            self._heard = now
        return client == self.driver

    def open(self, ticket: Ticket) -> None:
        self._arm.see(ticket)
        self._open[ticket.stamp] = ticket

    def answer(self, stamp: int, command: Command) -> Answer | None:
        """The answer to the telemetry of this stamp; None when it had one already."""
        ticket = self._open.pop(stamp, None)
        if ticket is None:
            return None
        if not command.pickup:
            return Answer(ticket.client, command, "answered")
        if ticket.picking_up or self._arm.busy:
            return Answer(ticket.client, SAFE_COMMAND, "pickup_already_running")
        # With no sample in reach the simulator would freeze for good, and a newer telemetry may
        # have told already that the rover has rolled past it.
        if not (_can_pick_up(ticket) and self._arm.can_pick_up):
            return Answer(ticket.client, SAFE_COMMAND, "pickup_refused")
        self._arm.start()
        return Answer(ticket.client, command, "pickup_sent")

    def expire(self, now: float) -> list[Answer]:
        """Safe answers for all telemetries that have waited too long at `now` [s] of wall time."""
        late = [t for t in self._open.values() if now - t.arrived >= self._deadline]
        for ticket in late:
            del self._open[ticket.stamp]
        return [Answer(ticket.client, SAFE_COMMAND, "deadline_missed") for ticket in late]

    def leave(self, client: str) -> None:
        """A client is gone: nothing is owed to it, and another one may drive."""
        if client == self.driver:
            self.driver = None
            self._open.clear()


def _can_pick_up(ticket: Ticket) -> bool:
    return ticket.near_sample and abs(ticket.speed) <= ROVER.pickup_speed


class _Arm:
    """What the newest telemetry says of the arm, and whether a pickup has yet to show in one."""

    def __init__(self) -> None:
        self._newest: Ticket | None = None
        self._sent = False
        self._unseen = 0

    @property
    def busy(self) -> bool:
        """A pickup runs, or one was sent."""
        return self._sent or (self._newest is not None and self._newest.picking_up)

    @property
    def can_pick_up(self) -> bool:
        return self._newest is not None and _can_pick_up(self._newest)

    def start(self) -> None:
        self._sent, self._unseen = True, 0

    def see(self, ticket: Ticket) -> None:
        """A telemetry came in."""
        self._newest = ticket
        self._unseen += 1
        if ticket.picking_up or self._unseen >= PICKUP_TELEMETRIES:
            self._sent = False  # from now on the telemetry itself tells
