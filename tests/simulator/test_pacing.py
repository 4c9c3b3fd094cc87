"""Telemetries over a socket: pending ones, reconnects, and what bad input does to both."""

from __future__ import annotations

import threading
import time
from collections.abc import Callable, Iterator

import numpy as np
import pytest
from raw_server import HANDSHAKE, PING, WAIT, RawServer, Wire

from rover_common.geometry import Pose
from rover_simulator.simulation import Simulation
from rover_simulator.wire.pacing import LockstepPacing, Pacing, TimedPacing, run_connected
from rover_simulator.wire.unity_client import UnityClient
from rover_simulator.world.world import World

FRAME = 0.04  # [s]
MANUAL = '42["manual",{}]'
DRIVE = {"steering_angle": "0", "throttle": "0.2", "brake": "0"}

Start = Callable[[Pacing], RawServer]


@pytest.fixture(scope="module")
def simulation() -> Simulation:
    """One for all tests, because making one takes seconds; each compares before and after."""
    hall = np.zeros((200, 200), bool)
    hall[80:121, 20:181] = True
    return Simulation(World("hall", hall, np.zeros((0, 2)), Pose(30, 100, 0)), 0, 2)


@pytest.fixture
def start() -> Iterator[Start]:
    """Runs a pacing in a thread, against a raw server."""
    server = RawServer()
    ended = threading.Event()
    threads: list[threading.Thread] = []

    def run(pacing: Pacing) -> RawServer:
        client = UnityClient("127.0.0.1", server.port)
        thread = threading.Thread(target=run_connected, args=(client, pacing, ended.is_set))
        threads.append(thread)
        thread.start()
        return server

    yield run
    ended.set()
    server.close()  # also ends a receive of the client
    for thread in threads:
        thread.join()


def nothing() -> None:
    pass


def lockstep(simulation: Simulation) -> LockstepPacing:
    return LockstepPacing(simulation, nothing)


def timed(simulation: Simulation) -> TimedPacing:
    return TimedPacing(simulation, nothing, period=0.02)


def opened(server: RawServer) -> Wire:
    """A connection that has received the two telemetries that come unasked."""
    wire = server.accept()
    assert wire.message() == PING
    first = wire.telemetry()
    wire.send(HANDSHAKE)
    wire.send("40")
    assert wire.telemetry().keys() == first.keys()
    return wire


def time_of(telemetry: dict[str, str]) -> float:
    return float(telemetry["sim_time"])


def test_a_telemetry_follows_the_open_socket_and_the_handshake(simulation, start):
    server = start(lockstep(simulation))
    wire = server.accept()
    assert wire.message() == PING
    assert wire.message().startswith('42["telemetry",')  # as the socket opens
    wire.send(HANDSHAKE)
    assert wire.message().startswith('42["telemetry",')
    wire.send("2")
    assert wire.message() == "3"  # and no further telemetry


def test_lockstep_answers_the_first_two_together_and_then_one_by_one(simulation, start):
    wire = opened(start(lockstep(simulation)))
    before = simulation.time
    wire.send(MANUAL)
    wire.send(PING)
    assert wire.message() == "3"  # the other telemetry is still pending
    wire.send(MANUAL)
    for count in range(1, 6):
        assert time_of(wire.telemetry()) == pytest.approx(before + count * FRAME)
        wire.emit("get_samples", {})  # ignored, as every unknown event
        wire.emit("data", DRIVE)


def test_lockstep_goes_on_while_one_telemetry_is_pending(simulation, start):
    wire = opened(start(lockstep(simulation)))
    before = simulation.time
    wire.emit("data", DRIVE | {"throttle": 0.2})  # a JSON number: loses its answer
    wire.emit("data", DRIVE)
    assert time_of(wire.telemetry()) == pytest.approx(before + FRAME)


@pytest.mark.parametrize(
    "bad",
    [
        {"steering_angle": "0"},
        DRIVE | {"steering_angle": "NaN"},
        DRIVE | {"brake": "x"},
        DRIVE | {"inset_image1": "!"},
    ],
    ids=str,
)
@pytest.mark.parametrize("kind", [lockstep, timed])
def test_a_new_command_gets_a_telemetry_after_all_others_lost_theirs(simulation, start, kind, bad):
    wire = opened(start(kind(simulation)))
    wire.emit("data", bad)
    wire.emit("data", bad)
    for _ in range(3):
        wire.send(PING)
        assert wire.message() == "3"  # alive, but without a telemetry
    wire.emit("data", DRIVE)
    wire.telemetry()
    wire.send(MANUAL)
    wire.telemetry()


def test_timed_sends_one_telemetry_for_each_answer(simulation, start):
    wire = opened(start(timed(simulation)))
    times = []
    for _ in range(3):
        wire.send(MANUAL)
    for _ in range(40):
        times.append(time_of(wire.telemetry()))
        wire.emit("data", DRIVE)
    steps = np.diff(times) / FRAME
    assert np.allclose(steps, np.round(steps), atol=1e-3)
    assert (np.round(steps) >= 0).all()
    counts = np.unique(np.round(np.array(times) / FRAME), return_counts=True)[1]
    assert counts.max() <= 3  # one telemetry for each event, in each frame
    for _ in range(3):
        wire.telemetry()
    wire.send(PING)
    assert wire.message() == "3"


@pytest.mark.parametrize("kind", [lockstep, timed])
@pytest.mark.parametrize("bad", ['42["data",5]', '42["data",{},{}]', "42[]", "0{}"])
def test_an_event_of_the_wrong_shape_closes_the_connection_only(simulation, start, kind, bad):
    server = start(kind(simulation))
    before = simulation.time
    wire = opened(server)
    wire.emit("data", DRIVE | {"steering_angle": "7"})
    wire.send(bad)
    assert wire.ended()
    again = opened(server)
    again.send(MANUAL)
    again.send(MANUAL)
    telemetry = again.telemetry()
    assert telemetry["steering_angle"] == "7.0000"  # the controls are kept
    assert time_of(telemetry) > before


@pytest.mark.parametrize("kind", [lockstep, timed])
def test_a_compressed_frame_closes_the_connection_only(simulation, start, kind):
    server = start(kind(simulation))
    wire = opened(server)
    wire.send(MANUAL, first=0xC1)
    assert wire.ended()
    opened(server)


def test_the_rover_is_where_it_was_after_a_restart_of_the_server(simulation, start):
    server = start(lockstep(simulation))
    wire = opened(server)
    wire.send(MANUAL)
    wire.emit("data", DRIVE | {"throttle": "1"})
    for _ in range(50):
        last = wire.telemetry()
        wire.send(MANUAL)
    last = wire.telemetry()
    port = server.port
    server.close()
    restarted = RawServer(port)
    try:
        first = opened_telemetry(restarted)
        assert first == last  # no time passes without a server, in this mode
    finally:
        restarted.close()


def opened_telemetry(server: RawServer) -> dict[str, str]:
    """The telemetry that is sent as the socket opens."""
    wire = server.accept()
    assert wire.message() == PING
    return wire.telemetry()


def test_the_rover_drives_on_without_a_server(simulation, start):
    """In real time, as the original has no watchdog."""
    frames = threading.Semaphore(0)
    server = start(TimedPacing(simulation, frames.release, period=0.02))
    wire = opened(server)
    wire.emit("data", DRIVE | {"throttle": "1"})
    last = wire.telemetry()
    port = server.port
    server.close()
    while frames.acquire(blocking=False):
        pass
    for _ in range(30):
        assert frames.acquire(timeout=10)
    restarted = RawServer(port)
    try:
        first = opened_telemetry(restarted)
    finally:
        restarted.close()
    assert time_of(first) > time_of(last) + 20 * FRAME
    assert first["throttle"] == "1.0000"
    assert float(first["speed"]) > 0.5


def test_simulated_time_passes_during_a_flood_of_events(simulation, start):
    wire = opened(start(timed(simulation)))
    before = simulation.time
    end = time.monotonic() + WAIT
    while simulation.time < before + 5 * FRAME:
        wire.emit("get_samples", {})
        assert time.monotonic() < end, "no frame passes"
