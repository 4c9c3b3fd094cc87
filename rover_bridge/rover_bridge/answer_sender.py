"""Answers in the form that each client reads, with the insets that are finished."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable

from rover_bridge.codec import decimal_mark, encode_drive
from rover_bridge.insets import Insets
from rover_bridge.pending_requests import Answer
from rover_bridge.transport import Transport


class AnswerSender:
    """Sends and counts; a client with decimal commas is answered with decimal commas."""

    def __init__(
        self,
        transport: Transport,
        take_insets: Callable[[str], Insets],
        counts: Counter[str],
    ) -> None:
        """take_insets: those that are to be sent to a client now."""
        self._transport = transport
        self._take_insets = take_insets
        self._counts = counts
        self._comma_clients: set[str] = set()

    def read(self, client: str, wire: object) -> None:
        """A client's telemetry shows how it writes numbers."""
        mark = decimal_mark(wire)
        if mark == ",":
            self._comma_clients.add(client)
        elif mark:  # a value of before was odd, and not the machine
            self._comma_clients.discard(client)

    def forget(self, client: str) -> None:
        """It has left."""
        self._comma_clients.discard(client)

    def send(self, answer: Answer, refused: str = "") -> None:
        """refused: why the telemetry was not used; empty when it was."""
        self._counts[answer.counter] += 1
        if answer.command.pickup:
            self._transport.send(answer.client, "pickup", {})
            return
        comma, insets = answer.client in self._comma_clients, self._take_insets(answer.client)
        drive = encode_drive(answer.command, comma, insets, refused)
        self._transport.send(answer.client, "data", drive)
