"""Clients of the bridge that harm it: raw sockets to the loopback, bounded in number and time."""

from __future__ import annotations

import contextlib
import random
import socket
import struct
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

from rover_tools.chaos.wire_shapes import HANDSHAKE, WIRE_SHAPES, event
from rover_tools.runner.graph import HOST

Stopped = Callable[[], bool]

TIMEOUT = 1.0  # [s] to connect, to be answered and to send
READ = 0.2  # [s] for an answer to a shape
PAUSE = 0.02  # [s] between two bursts
BURST = 200  # messages of a flood at once
MOST_FLOODED = 5_000_000  # bytes of one fault: some 100,000 messages
MOST_HELD = 80  # idle connections of one fault: more than the bridge has places
MOST_SENT = 60  # connections of one fault that send a shape
FORGET = struct.pack("ii", 1, 0)  # SO_LINGER: the connection is reset when it is closed


@contextmanager
def connected(port: int, websocket: bool = True) -> Iterator[socket.socket]:
    """To the loopback alone; raises OSError, also when a WebSocket is refused."""
    with socket.create_connection((HOST, port), TIMEOUT) as connection:
        if websocket:
            connection.sendall(HANDSHAKE)
            if b" 101 " not in connection.recv(4096):
                raise ConnectionRefusedError("no WebSocket")
        yield connection


def flood(port: int, clients: int, stopped: Stopped) -> int:
    """Small telemetries as fast as they are taken, whose answers nobody reads; how many bytes."""
    burst, sent = event("telemetry", {"speed": "flood"}) * BURST, 0
    with contextlib.ExitStack() as stack:
        rests: dict[socket.socket, bytes] = {}  # of a burst that was taken in part
        for _ in range(clients):
            with contextlib.suppress(OSError):
                rests[stack.enter_context(connected(port))] = burst
        for connection in rests:
            connection.setblocking(False)
        while rests and not stopped() and sent < MOST_FLOODED:
            for connection, rest in list(rests.items()):
                try:
                    taken = connection.send(rest)
                except BlockingIOError:
                    continue
                except OSError:
                    del rests[connection]
                    continue
                rests[connection] = rest[taken:] or burst
                sent += taken
            time.sleep(PAUSE)
    return sent


def hold(port: int, websocket: bool, stopped: Stopped) -> int:
    """Connections that say nothing until the end; how many."""
    with contextlib.ExitStack() as stack:
        count = 0
        while count < MOST_HELD and not stopped():
            with contextlib.suppress(OSError):
                stack.enter_context(connected(port, websocket))
            count += 1
        while not stopped():
            time.sleep(PAUSE)
    return count


def send_shapes(port: int, shape: str, chance: random.Random, stopped: Stopped) -> int:
    """One connection after the other, each with what the shape makes; how many."""
    for sent in range(MOST_SENT):
        if stopped():
            return sent
        with contextlib.suppress(OSError), connected(port) as connection:
            connection.sendall(WIRE_SHAPES[shape](chance))
            if chance.random() < 0.5:  # others leave without a word
                connection.settimeout(READ)
                connection.recv(4096)
            else:
                connection.setsockopt(socket.SOL_SOCKET, socket.SO_LINGER, FORGET)
        time.sleep(PAUSE)
    return MOST_SENT
