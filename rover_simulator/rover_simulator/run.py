"""Run the simulator against a server until it is stopped or its time is up."""

from __future__ import annotations

import json
import math
import signal
import sys
from pathlib import Path

from rover_simulator.saved_simulation import SavedSimulation
from rover_simulator.sensors.screen import SavedScreen
from rover_simulator.simulation import Simulation
from rover_simulator.vehicle.vehicle import STEP
from rover_simulator.wire.pacing import (
    LockstepPacing,
    Pacing,
    TimedPacing,
    print_error,
    run_connected,
)
from rover_simulator.wire.unity_client import UnityClient
from rover_simulator.world.world import World


class Stop:
    """Set by SIGINT and SIGTERM; a second one ends the process, whatever it does."""

    def __init__(self) -> None:
        self.asked = False
        for number in (signal.SIGINT, signal.SIGTERM):
            signal.signal(number, self._ask)

    def _ask(self, number: int, _: object) -> None:
        self.asked = True
        signal.signal(number, signal.SIG_DFL)

    def __call__(self) -> bool:
        return self.asked


class Progress:
    """Prints where the simulation stands, once per simulated second, and the dead man's stops."""

    def __init__(self, simulation: Simulation, wanted: bool) -> None:
        self._simulation = simulation
        self._wanted = wanted
        self._next = 0.0  # [s]
        self._stops = 0  # of the dead man, that were told

    def update(self) -> None:
        if self._simulation.dead_man_stops > self._stops:
            self._stops = self._simulation.dead_man_stops
            print("rover sim: no command in time: braking", file=sys.stderr, flush=True)
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
            "dead_man_stops": simulation.dead_man_stops,
            "longest_unbraked": round(simulation.longest_unbraked, 3),
        }
        print(json.dumps(line), flush=True)


def simulate(
    world: World,
    seed: int,
    *,
    host: str,
    port: int,
    rate: float | None,
    fps: float,
    time_limit: float,
    dead_man: float,
    progress: bool,
    insets: Path | None,
    state: Path | None = None,
) -> None:
    """Drive in the world as the server commands.

    rate: times real time, None as fast as the server answers; fps: frames per simulated second;
    time_limit [s]: of simulated time; dead_man [s]: of it without a command until the rover brakes,
    0 for never; insets: folder to save into what the screen would show; state: file to go on from,
    if it is there, and to keep up to date.
    """
    stop = Stop()
    frame_steps = frame_steps_of(fps)
    simulation = Simulation(world, seed, frame_steps, dead_man or math.inf)
    if insets is not None:
        simulation.show_insets(SavedScreen(insets).show)
    reports = Progress(simulation, progress)
    on_frame = [reports.update]
    if state is not None:
        saved = SavedSimulation(state, world, simulation)
        for refusal in saved.resume():
            print(f"rover sim: {refusal}", file=sys.stderr)
        on_frame.append(saved.update)

    def update() -> None:
        for part in on_frame:
            part()

    pacing: Pacing = LockstepPacing(simulation, update)
    if rate is not None:
        pacing = TimedPacing(simulation, update, frame_steps * STEP / rate)
    client = UnityClient(host, port, print_error)
    run_connected(client, pacing, lambda: stop() or simulation.time >= time_limit)
    reports.report()


def frame_steps_of(fps: float) -> int:
    """Physics steps in one frame at a frame rate [1/s]."""
    return max(1, round(1.0 / (fps * STEP)))
