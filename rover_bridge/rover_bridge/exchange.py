"""Who is owed an answer: every telemetry gets exactly one, decided on it, or safe."""

from __future__ import annotations

from dataclasses import dataclass

from rover_common.dataflow import SAFE_COMMAND, Command

# A rover that rolls this slowly still holds its sample in reach while the arm starts.
STANDING_SPEED = 0.2  # [m/s]
# Telemetries that may pass before a pickup that was sent must show: the exchanges in flight, twice.
PICKUP_TELEMETRIES = 6


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
        self._last_stamp = 0
        self.driver: str | None = None

    def admit(self, client: str) -> bool:
        """Whether this client drives: the first one does, until it leaves."""
        if self.driver is None:
            self.driver = client
            self._arm = _Arm()
        return client == self.driver

    def next_stamp(self, wanted: int) -> int:
        """The stamp [ns] for a telemetry of this time: later than the one before.

        Two telemetries of one simulated frame have the same time; a stamp names one of them. Time
        that falls back is a new run, and stays as it is.
        """
        if 0 <= self._last_stamp - wanted < 1_000_000:
            wanted = self._last_stamp + 1
        self._last_stamp = wanted
        return wanted

    def open(self, ticket: Ticket) -> None:
        self._arm.see(ticket.picking_up)
        self._open[ticket.stamp] = ticket

    def answer(self, stamp: int, command: Command) -> Answer | None:
        """The answer to the telemetry of this stamp; None when it had one already."""
        ticket = self._open.pop(stamp, None)
        if ticket is None:
            return None
        if not command.pickup:
            return Answer(ticket.client, command, "answered")
        if ticket.picking_up or not self._arm.free:
            return Answer(ticket.client, SAFE_COMMAND, "pickup_already_running")
        # With no sample in reach the simulator would freeze for good.
        if not ticket.near_sample or abs(ticket.speed) > STANDING_SPEED:
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


class _Arm:
    """Whether a pickup may be sent: not while one that was sent runs, or has yet to show."""

    def __init__(self) -> None:
        self._sent = False
        self._unseen = 0

    @property
    def free(self) -> bool:
        return not self._sent

    def start(self) -> None:
        self._sent, self._unseen = True, 0

    def see(self, picking_up: bool) -> None:
        """A telemetry came in."""
        if not self._sent:
            return
        self._unseen += 1
        if picking_up or self._unseen >= PICKUP_TELEMETRIES:
            self._sent = False  # from now on the telemetry itself tells
