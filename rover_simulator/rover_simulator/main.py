"""`rover sim`: the embedded simulator, a client that any rover server can be driven by."""

from __future__ import annotations

import argparse
import json
import math
import signal
import sys
from pathlib import Path

from rover_common.ground_truth import TruthError
from rover_simulator.simulation import Simulation
from rover_simulator.vehicle.vehicle import STEP
from rover_simulator.wire.exchange import Exchange, FastExchange, TimedExchange, keep_exchanging
from rover_simulator.wire.unity_client import UnityClient
from rover_simulator.world.generator import generate_world, world_of_map
from rover_simulator.world.world import World, WorldError

FPS = 25.0  # frames per second unless others are asked for


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
    options = option_parser().parse_args(arguments)
    stop = Stop()
    try:
        world = world_of(options)
    except (TruthError, WorldError, OSError) as error:
        print(f"rover sim: {error}", file=sys.stderr)
        return 1
    frame_steps = frame_steps_of(options.fps)
    simulation = Simulation(world, options.seed, frame_steps)
    progress = Progress(simulation, options.progress)
    exchange: Exchange = FastExchange(simulation, progress.update)
    if options.rate != "fast":
        period = frame_steps * STEP / _rate(options.rate)
        exchange = TimedExchange(simulation, progress.update, period)
    keep_exchanging(
        UnityClient(options.host, options.port),
        exchange,
        lambda: stop() or simulation.time >= options.time_limit,
    )
    progress.report()
    return 0


def frame_steps_of(fps: float) -> int:
    """Physics steps in one frame at a frame rate [1/s]."""
    return max(1, round(1.0 / (fps * STEP)))


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


def option_parser() -> argparse.ArgumentParser:
    """Of `rover sim`; the README lists them all."""
    parser = argparse.ArgumentParser(prog="rover sim", description=__doc__)
    add = parser.add_argument
    add("--host", default="127.0.0.1", help="of the server (default: %(default)s)")
    add("--port", type=_port, default=4567, help="of the server (default: %(default)s)")
    add_world_options(parser)
    add("--rate", type=_checked_rate, default="realtime",
        help="realtime, fast (as the server answers), or N times real time")  # fmt: skip
    add("--fps", type=fps_option, default=FPS,
        help="frames per second, made 50 over a whole number (default: %(default)s)")  # fmt: skip
    add("--time-limit", type=float, default=float("inf"), metavar="S",
        help="end when the simulated time, which begins at 1 s, reaches this [s]")  # fmt: skip
    add("--progress", action="store_true", help="print a JSON line per simulated second")
    return parser


def _port(text: str) -> int:
    port = int(text)
    if not 0 < port < 65536:
        raise argparse.ArgumentTypeError("a port is 1 to 65535")
    return port


def fps_option(text: str) -> float:
    """A frame rate from the command line."""
    fps = float(text)
    if not (math.isfinite(fps) and fps > 0):
        raise argparse.ArgumentTypeError("a positive number")
    return fps


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


if __name__ == "__main__":
    sys.exit(main())
