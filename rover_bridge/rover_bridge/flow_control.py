"""Each client's share of the server: how often it is read, and how much it may leave unanswered.

A client that sends more is not read for a while. TCP then stops it at its own end, so that nothing
of it is lost, and nothing piles up here.
"""

from __future__ import annotations

import time
from collections.abc import Callable

import eventlet

from rover_bridge.rate_limit import TokenBucket
from rover_common.errors import RoverError

BURST = 32  # messages of a client that are read at once
MAX_OWED = 16  # telemetries of a client that wait for their answers
MAX_QUEUED = 64  # packets that wait until a client reads them
STALL_SECONDS = 10.0  # [s] in which a client has to read what waits for it
POLL_SECONDS = 0.01  # [s] between two looks at a client that is not read


class StalledClientError(RoverError):
    """A client sends and does not read."""


class ClientGoneError(RoverError):
    """A client has ended its connection, with more left to read than its rate allows."""


class ClientFlow:
    """Of one client, in the server's thread."""

    def __init__(
        self, rate: float, queued: Callable[[], int], gone: Callable[[], bool] = lambda: False
    ) -> None:
        """rate [1/s]: of messages that are read; queued: packets on their way to the client;
        gone: whether it has ended its connection.
        """
        self._messages = TokenBucket(rate, BURST)
        self._queued = queued
        self._gone = gone
        self.owed = 0  # telemetries without their answer
        self.last_heard = time.monotonic()  # [s]

    def wait_turn(self) -> None:
        """Wait until the next message may be handled; the other clients have their turns first.

        Raises StalledClientError for a client that does not read its answers, ClientGoneError for
        one that has left.
        """
        self.last_heard = now = time.monotonic()
        delay = self._messages.take(now)
        if delay > 0.0 and self._gone():
            raise ClientGoneError("a client has left more than is read")
        eventlet.sleep(delay)
        while self.owed >= MAX_OWED or self._queued() >= MAX_QUEUED:
            if time.monotonic() - now > STALL_SECONDS:
                raise StalledClientError("a client does not read its answers")
            eventlet.sleep(POLL_SECONDS)
