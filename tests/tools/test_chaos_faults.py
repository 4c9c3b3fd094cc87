"""Faults on processes and sockets that stand in for the graph's."""

from __future__ import annotations

import contextlib
import random
import signal
import socket
import socketserver
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from waiting import holds

from rover_bridge.codec import decode_telemetry
from rover_bridge.errors import TelemetryError
from rover_tools.chaos import wire_client
from rover_tools.chaos.faults import Faults
from rover_tools.chaos.plan import Fault, Kind
from rover_tools.chaos.wire_client import MOST_HELD
from rover_tools.chaos.wire_shapes import GOOD, WIRE_SHAPES, event
from rover_tools.runner.graph import HOST

WAIT = 10.0  # [s]
NODE = "decision_node"


class StandIn:
    """One process under the name of a node."""

    def __init__(self) -> None:
        code = "import signal; print('up', flush=True); signal.pause()"
        self.process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
        assert self.process.stdout is not None
        self.process.stdout.readline()

    def pid(self, name: str) -> int:
        assert name == NODE
        return self.process.pid

    def state(self) -> str:
        """As the kernel has it: S for one that sleeps, T for one that is stopped."""
        return Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()[0]


class Listener(socketserver.ThreadingTCPServer):
    """Answers each WebSocket's handshake, and keeps what it is sent."""

    request_queue_size = MOST_HELD

    def __init__(self) -> None:
        super().__init__((HOST, 0), Connection)
        self.port = int(self.server_address[1])
        self.received: list[bytes] = []
        self.open = 0
        self._thread = threading.Thread(target=self.serve_forever, args=(0.01,))
        self._thread.start()

    def close(self) -> None:
        self.shutdown()
        self._thread.join()
        self.server_close()


class Connection(socketserver.BaseRequestHandler):
    server: Listener

    def handle(self) -> None:
        self.server.open += 1
        content, handshake = b"", b"\r\n\r\n"
        with contextlib.suppress(OSError):
            while data := self.request.recv(65536):
                content += data
                if handshake and handshake in content:
                    content, handshake = content.partition(handshake)[2], b""
                    self.request.sendall(b"HTTP/1.1 101 Switching Protocols\r\n\r\n")
        self.server.received.append(content)
        self.server.open -= 1


@pytest.fixture
def node() -> Iterator[StandIn]:
    stand_in = StandIn()
    yield stand_in
    stand_in.process.kill()
    stand_in.process.communicate()


@pytest.fixture
def listener() -> Iterator[Listener]:
    made = Listener()
    yield made
    made.close()


def wait_for(predicate: Callable[[], bool]) -> None:
    assert holds(predicate, WAIT), "it did not happen in time"


def faults(nodes: object = None, port: int = 0, publish: object = None) -> Faults:
    return Faults(nodes, port, publish, 3)  # type: ignore[arg-type]


def test_a_node_is_stopped_and_goes_on(node):
    end = faults(node).begin(Fault(1, 0.0, Kind.STOP, NODE, 1.0))
    wait_for(lambda: node.state() == "T")
    end()
    wait_for(lambda: node.state() == "S")
    assert node.process.poll() is None


def test_a_node_is_killed(node):
    end = faults(node).begin(Fault(1, 0.0, Kind.KILL, NODE, 0.0))
    end()
    assert node.process.wait(WAIT) == -signal.SIGKILL


def test_a_node_that_has_ended_needs_no_signal(node):
    node.process.kill()
    node.process.wait()
    for kind in (Kind.STOP, Kind.KILL):
        faults(node).begin(Fault(1, 0.0, kind, NODE, 1.0))()


@pytest.mark.parametrize("target", ["tcp", "websocket"])
def test_idle_connections_are_open_until_the_end(listener, target):
    end = faults(port=listener.port).begin(Fault(1, 0.0, Kind.IDLE, target, 1.0))
    wait_for(lambda: listener.open == MOST_HELD)
    end()
    wait_for(lambda: listener.open == 0)
    assert set(listener.received) == {b""}


def test_a_flood_is_of_whole_messages_and_bounded(listener, monkeypatch):
    monkeypatch.setattr(wire_client, "MOST_FLOODED", 1_000_000)
    end = faults(port=listener.port).begin(Fault(1, 0.0, Kind.FLOOD, "4 clients", 1.0))
    wait_for(lambda: len(listener.received) == 4)
    end()
    message = event("telemetry", {"speed": "flood"})
    for content in listener.received:
        assert content.startswith(message)
        assert content.replace(message, b"") == message[: len(content) % len(message)]
    total = sum(map(len, listener.received))
    assert 1_000_000 <= total < 1_000_000 + 4 * wire_client.BURST * len(message)


@pytest.mark.parametrize("shape", WIRE_SHAPES)
def test_bytes_of_every_shape_are_sent_and_repeat_by_the_seed(listener, shape, monkeypatch):
    monkeypatch.setattr(wire_client, "MOST_SENT", 3)
    fault = Fault(1, 0.0, Kind.WIRE, shape, 1.0)
    for connections in (3, 6):
        end = faults(port=listener.port).begin(fault)
        wait_for(lambda wanted=connections: len(listener.received) == wanted)
        end()
    first, second = listener.received[:3], listener.received[3:]
    assert any(first)
    # A connection that is reset may lose its last bytes.
    assert any(content and content in second for content in first)


def test_no_bridge_is_no_error():
    with socket.create_server((HOST, 0)) as closed:
        port = closed.getsockname()[1]
    for kind, target in ((Kind.FLOOD, "1 client"), (Kind.IDLE, "tcp"), (Kind.WIRE, "garbage")):
        faults(port=port).begin(Fault(1, 0.0, kind, target, 1.0))()


def test_a_shape_of_the_graph_is_published_until_the_end():
    story: list[str] = []

    def publish(shape: str, stopped: Callable[[], bool]) -> int:
        story.append(shape)
        assert holds(stopped, WAIT)
        story.append("stopped")
        return 1

    end = faults(publish=publish).begin(Fault(1, 0.0, Kind.GRAPH, "empty scan", 1.0))
    end()
    assert story == ["empty scan", "stopped"]


def test_no_telemetry_of_ours_can_take_the_rover_over():
    with pytest.raises(TelemetryError):
        decode_telemetry(GOOD)


def test_every_shape_repeats_by_its_chance():
    for make in WIRE_SHAPES.values():
        assert make(random.Random(5)) == make(random.Random(5))
