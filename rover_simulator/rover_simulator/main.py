"""`rover sim`: the embedded simulator, a client that any rover server can be driven by."""

from __future__ import annotations

import argparse
import json
import signal
import sys
import time
from pathlib import Path

from rover_common.scoring import TruthError
from rover_simulator.simulation import Simulation
from rover_simulator.unity_client import OPEN, ConnectionLostError, ProtocolError, UnityClient
from rover_simulator.vehicle import STEP
from rover_simulator.world import World, WorldError
from rover_simulator.worldgen import generate_world, world_of_map

WAIT = 0.5  # [s] between looks whether to stop


class Stop:
    """Set by SIGINT and SIGTERM."""

    def __init__(self) -> None:
        self.asked = False
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._ask)

    def _ask(self, *_: object) -> None:
        self.asked = True

    def __call__(self) -> bool:
        return self.asked


def main(arguments: list[str] | None = None) -> int:
    """Returns the exit code: 0 after a signal or the time limit, 1 for a bad world."""
    options = _parser().parse_args(arguments)
    stop = Stop()
    try:
        world = world_of(options)
    except (TruthError, WorldError, OSError) as error:
        print(f"rover sim: {error}", file=sys.stderr)
        return 1
    frame_steps = max(1, round(1.0 / (options.fps * STEP)))
    simulation = Simulation(world, options.seed, frame_steps)
    client = UnityClient(options.host, options.port)
    progress = Progress(simulation, options.progress)
    while not stop() and client.connect_until(stop):
        try:
            if options.rate == "fast":
                _run_fast(simulation, client, stop, progress, options.time_limit)
            else:
                period = frame_steps * STEP / _rate(options.rate)
                _run_timed(simulation, client, stop, progress, options.time_limit, period)
        except (ConnectionLostError, ProtocolError) as error:
            print(f"rover sim: {error}; connecting again", file=sys.stderr)
        else:
            break
        finally:
            client.close()
    progress.report()
    return 0


def add_world_options(parser: argparse.ArgumentParser) -> None:
    """Which world to drive in."""
    parser.add_argument("--seed", type=int, default=1,
        help="of the generated world, or of a map's samples (default: %(default)s)")  # fmt: skip
    instead = parser.add_mutually_exclusive_group()
    instead.add_argument("--map", type=Path, metavar="PNG",
        help="a map of 200 x 200 pixels instead, white is ground")  # fmt: skip
    instead.add_argument("--world", type=Path, metavar="DIR",
        help="a world's folder instead: map.png, world.yaml")  # fmt: skip


def world_of(options: argparse.Namespace) -> World:
    """The chosen world; raises TruthError or WorldError."""
    if options.world is not None:
        return World.load(options.world)
    if options.map is not None:
        return world_of_map(options.map, options.seed)
    return generate_world(options.seed)


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(prog="rover sim", description=__doc__)
    add = parser.add_argument
    add("--host", default="127.0.0.1", help="of the server (default: %(default)s)")
    add("--port", type=int, default=4567, help="of the server (default: %(default)s)")
    add_world_options(parser)
    add("--rate", type=_checked_rate, default="realtime",
        help="realtime, fast (as the server answers), or N times real time")  # fmt: skip
    add("--fps", type=float, default=25.0, help="frames per second (default: %(default)s)")
    add("--time-limit", type=float, default=float("inf"), metavar="S",
        help="end after this simulated time [s]")  # fmt: skip
    add("--progress", action="store_true", help="print a JSON line per simulated second")
    return parser


def _checked_rate(text: str) -> str:
    if text not in ("realtime", "fast") and not _rate(text) > 0:
        raise argparse.ArgumentTypeError("realtime, fast or a positive number")
    return text


def _rate(text: str) -> float:
    return 1.0 if text == "realtime" else float(text)


class Progress:
    """Prints where the simulation stands, once per simulated second."""

    def __init__(self, simulation: Simulation, wanted: bool) -> None:
        self._simulation = simulation
        self._wanted = wanted
        self._next = 0.0

    def update(self) -> None:
        if self._simulation.time >= self._next:
            self._next = self._simulation.time + 1.0
            self.report()

    def report(self) -> None:
        if not self._wanted:
            return
        simulation = self._simulation
        line = {
            "time": round(simulation.time, 2),
            "x": round(simulation.pose.x, 2),
            "y": round(simulation.pose.y, 2),
            "samples_left": simulation.samples_left,
            "contacts": simulation.contacts,
            "distance": round(simulation.distance, 2),
        }
        print(json.dumps(line), flush=True)


def _run_fast(
    simulation: Simulation, client: UnityClient, stop: Stop, progress: Progress, limit: float
) -> None:
    """One exchange in flight: each answered telemetry advances the simulation by one frame.

    On connecting there are two telemetries, as in the original; both are answered first.
    """
    client.send_telemetry(simulation.telemetry())
    waiting = 1
    while not stop() and simulation.time < limit:
        event = client.receive(WAIT)
        if event is None:
            continue
        if event.name == OPEN:
            client.send_telemetry(simulation.telemetry())
            waiting += 1
        elif simulation.handle(event.name, event.data):
            waiting -= 1
        if waiting == 0:
            simulation.advance()
            progress.update()
            client.send_telemetry(simulation.telemetry())
            waiting = 1


def _run_timed(
    simulation: Simulation,
    client: UnityClient,
    stop: Stop,
    progress: Progress,
    limit: float,
    period: float,
) -> None:
    """Frames at a period [s] of wall time, whether the server answers or not."""
    client.send_telemetry(simulation.telemetry())
    next_frame = time.monotonic() + period
    tokens = 0
    while not stop() and simulation.time < limit:
        event = client.receive(max(0.0, next_frame - time.monotonic()))
        if event is not None:
            tokens += event.name == OPEN or simulation.handle(event.name, event.data)
            continue
        if time.monotonic() < next_frame:
            continue
        next_frame = max(next_frame + period, time.monotonic() - period)
        simulation.advance()
        progress.update()
        for _ in range(tokens):
            client.send_telemetry(simulation.telemetry())
        tokens = 0


if __name__ == "__main__":
    sys.exit(main())
