"""A simulator without a server waits, and says so."""

from __future__ import annotations

from collections.abc import Callable

from raw_server import RawServer

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
