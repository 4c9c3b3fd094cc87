"""Clients that harm, in processes of their own: so they take no time of the server's interpreter.

By hand: python tests/flooders.py flood PORT --rate 10000 --seconds 5
"""

from __future__ import annotations

import argparse
import json
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from rover_tools.chaos import wire_shapes

HANDSHAKE = (
    "GET /socket.io/?EIO=4&transport=websocket HTTP/1.1\r\nHost: 127.0.0.1\r\n"
    "Upgrade: websocket\r\nConnection: Upgrade\r\nSec-WebSocket-Version: 13\r\n"
    "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n"
)
STARTED = "started"  # the first line that each prints
PIECE = 0.05  # [s] between two bursts of a flood at a rate


def frame(text: str, opcode: int = 1, final: bool = True) -> bytes:
    """A WebSocket frame of a client; its mask is zero, so that it costs nothing here."""
    return wire_shapes.frame(text.encode(), opcode, final)


def open_websocket(port: int) -> socket.socket:
    """A WebSocket after its handshake; ConnectionError when it is refused."""
    connection = socket.create_connection(("127.0.0.1", port), timeout=5)
    connection.sendall(HANDSHAKE.encode())
    answer = connection.recv(4096)
    if b" 101 " not in answer:
        raise ConnectionError(answer.decode(errors="replace"))
    return connection


def flood(port: int, clients: int, rate: float, seconds: float) -> None:
    """Send small telemetries from each client, at a rate [1/s] or 0 for as fast as it can, and
    read no answer.
    """
    message = frame("42" + json.dumps(["telemetry", {"speed": "flood"}]))
    count = max(1, round(rate * PIECE)) if rate else 1000
    connections = [open_websocket(port) for _ in range(clients)]
    for connection in connections:
        connection.setblocking(False)
    print(STARTED, flush=True)
    rests = [b""] * clients
    sent, end = 0, time.monotonic() + seconds
    while time.monotonic() < end:
        for index, connection in enumerate(connections):
            rests[index] = rests[index] or message * count
            try:
                done = connection.send(rests[index])
            except BlockingIOError:
                continue
            except OSError:
                return
            sent += done // len(message)
            rests[index] = rests[index][done:]
        time.sleep(PIECE)
    print(f"{sent} messages sent")


def hold(port: int, clients: int, kind: str, seconds: float) -> None:
    """Open so many connections and send nothing more: plain TCP, or WebSockets."""
    connections = []
    for _ in range(clients):
        try:
            if kind == "websocket":
                connections.append(open_websocket(port))
            else:
                connections.append(socket.create_connection(("127.0.0.1", port), timeout=5))
        except OSError:
            continue
    print(STARTED, flush=True)
    time.sleep(seconds)


@contextmanager
def running(*arguments: object) -> Iterator[None]:
    """One of them in a process, from its start on."""
    process = subprocess.Popen(
        [sys.executable, Path(__file__).resolve(), *map(str, arguments)],
        stdout=subprocess.PIPE,
        text=True,
    )
    try:
        assert process.stdout is not None
        assert process.stdout.readline().strip() == STARTED
        yield
    finally:
        process.kill()
        process.communicate()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("what", choices=("flood", "tcp", "websocket"))
    parser.add_argument("port", type=int)
    parser.add_argument("--clients", type=int, default=1)
    parser.add_argument("--rate", type=float, default=0.0, help="[1/s] of each, 0 for any")
    parser.add_argument("--seconds", type=float, default=5.0)
    options = parser.parse_args()
    if options.what == "flood":
        flood(options.port, options.clients, options.rate, options.seconds)
    else:
        hold(options.port, options.clients, options.what, options.seconds)


if __name__ == "__main__":
    main()
