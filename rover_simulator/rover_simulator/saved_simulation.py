"""Saves a simulation once per simulated second, so that it goes on after its process was killed."""

from __future__ import annotations

import zlib
from pathlib import Path

from rover_common.saved_state import SavedState, StateFile
from rover_common.types import FIRST_RUN
from rover_simulator.simulation import Simulation
from rover_simulator.world.world import World

VERSION = 1  # of what is saved
PERIOD = 1.0  # [s] of simulated time


class SavedSimulation:
    """Its file; the world's content is part of it, so that no other world goes on from it."""

    def __init__(self, path: Path, world: World, simulation: Simulation) -> None:
        self._file = StateFile(path, "simulation", VERSION)
        self._world = world_checksum(world)
        self._simulation = simulation
        self._due = 0.0  # [s] of simulated time
        self._samples_left = simulation.samples_left

    def resume(self) -> list[str]:
        """Go on from the file, if it is there; a line for each that is refused."""
        states, refusals = self._file.read()
        for state in states:
            try:
                if state.values["world"] != self._world:
                    raise ValueError("it is of another world")
                self._simulation.resume(state.values["simulation"])
            except (ValueError, TypeError, KeyError) as error:
                refusals.append(f"{self._file.path} is not used: {error}")
                continue
            break
        self._samples_left = self._simulation.samples_left
        return refusals

    def update(self) -> None:
        """Once per frame, before it is sent: a sample that is gone must not be there again."""
        simulation = self._simulation
        gone = simulation.samples_left != self._samples_left
        if simulation.time < self._due and not gone:
            return
        self._due, self._samples_left = simulation.time + PERIOD, simulation.samples_left
        values = {"world": self._world, "simulation": simulation.memory()}
        self._file.write(SavedState(FIRST_RUN, round(simulation.time * 1e9), values))


def world_checksum(world: World) -> int:
    """Of its map, its samples and its start."""
    places = world.samples.tobytes() + repr(world.start).encode()
    return zlib.crc32(places, zlib.crc32(world.navigable.tobytes()))
