"""Which client is the active one: the one whose telemetries are decided on."""

from __future__ import annotations

from dataclasses import dataclass

# An active client that owes a telemetry for this long may be gone: reloading the simulator's scene
# leaves its socket open, and the reloaded simulator connects on another one.
SILENCE = 2.0  # [s] of wall time


@dataclass(frozen=True)
class _Client:
    address: str  # of its machine
    connected: float  # [s] wall time


class ActiveClient:
    """The first client whose telemetry can be used is active until its connection ends.

    One other may take over: a simulator that was reloaded. It is on the same machine, and has
    connected after the active one was last heard. So neither a client that waits, nor one
    elsewhere, becomes active because the simulator pauses.
    """

    def __init__(self) -> None:
        self.name: str | None = None
        self._clients: dict[str, _Client] = {}
        self._last_heard = 0.0  # [s] wall time of the active client's latest telemetry

    def connect(self, client: str, address: str, now: float) -> None:
        """A client has connected at `now` [s] of wall time."""
        self._clients[client] = _Client(address, now)

    def accepts(self, client: str, now: float, owes: bool) -> bool:
        """Whether this client, heard at `now` [s] of wall time, is the active one or may become it.

        owes: whether the active client has all its answers, so that the next telemetry is its.
        """
        if client == self.name:
            self._last_heard = now
            return True
        return self.name is None or (owes and self._replaces(client, now))

    def activate(self, client: str, now: float) -> None:
        """A client that is accepted has sent a telemetry that can be used."""
        self.name = client
        self._last_heard = now

    def silence(self, now: float) -> float:
        """[s] since the active client was last heard."""
        return now - self._last_heard

    def disconnect(self, client: str) -> bool:
        """A client has left; whether it was the active one."""
        self._clients.pop(client, None)
        if client != self.name:
            return False
        self.name = None
        return True

    def _replaces(self, client: str, now: float) -> bool:
        old, new = self._clients.get(self.name or ""), self._clients.get(client)
        return (
            old is not None
            and new is not None
            and new.address == old.address
            and new.connected > self._last_heard
            and self.silence(now) >= SILENCE
        )
