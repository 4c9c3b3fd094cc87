"""A simulator without a server waits, and says so."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

from raw_server import WAIT, RawServer

from rover_simulator.node import SimulatorNode
from rover_simulator.wire import unity_client
from rover_simulator.wire.pacing import run_connected
from rover_simulator.wire.unity_client import UnityClient


def test_it_is_said_once_that_there_is_no_server(monkeypatch, capsys):
    monkeypatch.setattr(unity_client, "RECONNECT_PAUSE", 0.0)
    attempts: list[None] = []

    class Counting:
        def run(self, client: UnityClient, ended: Callable[[], bool]) -> None:
            raise AssertionError("there is no server")

        def while_disconnected(self) -> None:
            attempts.append(None)

    server = RawServer()
    server.close()
    run_connected(UnityClient("127.0.0.1", server.port), Counting(), lambda: len(attempts) == 3)
    said = f"rover sim: no server on 127.0.0.1:{server.port}; waiting for one\n"
    assert capsys.readouterr().err == said


def test_it_is_said_once_that_a_server_does_not_answer(monkeypatch):
    monkeypatch.setattr(unity_client, "SILENCE", 0.02)
    server, told = RawServer(), []
    client = UnityClient("127.0.0.1", server.port, told.append)
    with ThreadPoolExecutor(1) as pool:
        accepted = pool.submit(server.accept)
        client.connect(WAIT)
        wire = accepted.result(WAIT)
    assert client.receive(0.1) is None  # nothing was asked
    assert told == []
    silent = f"connected to 127.0.0.1:{server.port}, which does not answer"
    for count in (1, 2):
        client.send_telemetry({})
        client.receive(0.1)
        client.receive(0.1)
        assert told == [silent] * count
        wire.emit("manual", {})
        assert client.receive(WAIT) is not None
    client.close()
    server.close()


def test_the_node_says_it_in_its_log(ros, capfd):
    server = RawServer()
    server.close()
    node = ros.add(SimulatorNode, size=0.35, port=server.port)
    said = f"[simulator_node]: no server on 127.0.0.1:{server.port}; waiting for one"
    heard: list[str] = []

    def is_said() -> bool:
        heard.append(capfd.readouterr().err)
        return said in "".join(heard)

    assert ros.spin_until(is_said), heard
    assert "rover sim:" not in "".join(heard)
    assert node.simulation is not None
