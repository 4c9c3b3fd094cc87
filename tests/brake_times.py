"""How long after the last command to drive the rover brakes, when a node is stopped or killed.

Run by hand, on an idle machine: the three nodes as processes, the embedded simulator in real time,
and one fault after the other while the rover drives.

./rover shell -c 'PYTHONPATH=tests:$PYTHONPATH python tests/brake_times.py --faults 200'
"""

from __future__ import annotations

import argparse
import os
import signal
import tempfile
import threading
import time
from collections import defaultdict
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from itertools import cycle, islice, product
from pathlib import Path
from typing import Any

import numpy as np
from waiting import holds

from rover_simulator.simulation import Simulation
from rover_simulator.vehicle.vehicle import STEP
from rover_simulator.wire.pacing import TimedPacing, run_connected
from rover_simulator.wire.unity_client import UnityClient
from rover_simulator.world.generator import generate_world
from rover_tools.runner.graph import NODES
from rover_tools.runner.run import Run, running_graph

PARAMETERS = Path(__file__).resolve().parents[1] / "rover_bringup" / "config" / "rover.yaml"
SEED = 7
FRAME_STEPS = 2  # 25 frames a second
DEAD_MAN = 0.5  # [s]
FAST = 1.0  # [m/s] at which a fault comes
STEADY = 0.5  # [s] of driving commands before a fault
WAIT = 120.0  # [s] for the rover to drive again
LONGEST = 10.0  # [s] for a brake
FAULTS = tuple(product(NODES, (signal.SIGSTOP, signal.SIGKILL)))


class WatchedSimulation(Simulation):
    """Notes on the steady clock when it is told to drive, and when it begins to brake."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.driven_at = 0.0  # [s] the last command to drive
        self.driving_since = 0.0  # [s] of commands to drive only
        self.braked_at = 0.0  # [s] the frame that began to brake

    @property
    def driving(self) -> bool:
        return self._controls.throttle > 0.0 and self._controls.brake == 0.0

    @property
    def speed(self) -> float:
        return self._vehicle.speed

    def handle(self, event: str, data: Mapping[str, Any]) -> bool:
        drove = self.driving
        accepted = super().handle(event, data)
        if self.driving:
            self.driven_at = time.monotonic()
            self.driving_since = self.driving_since if drove else self.driven_at
        return accepted

    def advance(self) -> None:
        now, braked = time.monotonic(), self._last_brake
        super().advance()
        self._last_brake = self._controls.brake > 0.0
        if self._last_brake and not braked:
            self.braked_at = now

    _last_brake = False


@contextmanager
def simulating(simulation: Simulation, run: Run, frame_steps: int) -> Iterator[None]:
    """In real time, in a thread of its own."""
    ended = threading.Event()
    pacing = TimedPacing(simulation, lambda: None, frame_steps * STEP)
    client = UnityClient(run.host, run.port)
    thread = threading.Thread(target=run_connected, args=(client, pacing, ended.is_set))
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()


def brake_time(simulation: WatchedSimulation, run: Run, node: str, number: int) -> float | None:
    """[s] from the last command to drive to the brake; None where the rover did not drive."""

    def drives() -> bool:
        run.processes.check()
        steady = time.monotonic() - simulation.driving_since > STEADY
        return simulation.driving and steady and simulation.speed > FAST

    if not holds(drives, WAIT):
        return None
    pid, fault = run.processes.pid(node), time.monotonic()
    os.kill(pid, number)
    braked = holds(lambda: simulation.braked_at > max(fault, simulation.driven_at), LONGEST)
    seconds = simulation.braked_at - simulation.driven_at if braked else LONGEST
    time.sleep(0.5)
    if number == signal.SIGSTOP:
        os.kill(pid, signal.SIGCONT)
    return seconds


def report(name: str, seconds: list[float]) -> None:
    p50, p99 = np.percentile(seconds, (50, 99))
    figures = f"p50 {1e3 * p50:.0f} ms, p99 {1e3 * p99:.0f} ms, worst {1e3 * max(seconds):.0f} ms"
    print(f"{name}: {len(seconds)} faults, {figures}", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--faults", type=int, default=12)
    parser.add_argument("--dead-man", type=float, default=DEAD_MAN)
    options = parser.parse_args()
    simulation = WatchedSimulation(generate_world(SEED), SEED, FRAME_STEPS, options.dead_man)
    times: dict[str, list[float]] = defaultdict(list)
    with (
        tempfile.TemporaryDirectory() as folder,
        running_graph(Path(folder), parameters_file=PARAMETERS) as run,
        simulating(simulation, run, FRAME_STEPS),
    ):
        run.processes.respawn(NODES, options.faults)
        for node, number in islice(cycle(FAULTS), options.faults):
            name = f"{node} {'stopped' if number == signal.SIGSTOP else 'killed'}"
            seconds = brake_time(simulation, run, node, number)
            if seconds is None:
                print(f"{name}: the rover did not drive within {WAIT:.0f} s", flush=True)
                continue
            print(f"{name}: {1e3 * seconds:.0f} ms", flush=True)
            times[name].append(seconds)
    for name, each in times.items():
        report(name, each)
    report("all", [seconds for each in times.values() for seconds in each])


if __name__ == "__main__":
    main()
