"""How fast the embedded simulator is with a server at the other end of its wire."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from pathlib import Path

from rover_bridge.server import SocketServer
from rover_bridge.transport import ServerEvent, TelemetryReceived
from rover_tools.evaluation.results import Result

FIRST, FRAMES = 20, 200  # frames before the count begins, and usually those that are counted
MOST_SECONDS = 120.0  # [s] for all of it
COMMAND = {"steering_angle": "3.0", "throttle": "0.3", "brake": "0.0"}


def wire_speed(seed: int, frames: int = FRAMES) -> Result:
    """Frames per second of processor time of `rover sim --rate fast`, all that it does included.

    Each telemetry is answered at once, by a server in this process, whose time does not count.
    Raises TimeoutError when the frames do not come.
    """
    cost = _Cost(frames)
    server = SocketServer("127.0.0.1", 0, lambda event: cost.count(event, server))
    command = [
        sys.executable, "-m", "rover_simulator.main", "--port", str(server.port),
        "--seed", str(seed), "--rate", "fast",
    ]  # fmt: skip
    simulator = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    cost.process = simulator.pid
    try:
        if not cost.done.wait(MOST_SECONDS):
            raise TimeoutError(f"no {FIRST + frames} frames in {MOST_SECONDS:.0f} s")
    finally:
        simulator.terminate()
        simulator.wait()
        server.close()
    return {"wire_frames_per_second": round(frames / (cost.end - cost.begin), 1)}


class _Cost:
    """Processor time [s] of a process at the first and after the last frame that counts."""

    def __init__(self, wanted: int) -> None:
        self._wanted = wanted  # frames that count
        self.process = 0
        self.begin = self.end = 0.0
        self.done = threading.Event()
        self._frames = 0

    def count(self, event: ServerEvent, server: SocketServer) -> None:
        """Answer a telemetry; called in the server's thread."""
        if not isinstance(event, TelemetryReceived):
            return
        if self._frames == FIRST:
            self.begin = processor_seconds(self.process)
        if self._frames == FIRST + self._wanted:
            self.end = processor_seconds(self.process)
            self.done.set()
        self._frames += 1
        server.send(event.client, "data", COMMAND)


def processor_seconds(process: int) -> float:
    """User and system time [s] that a process has taken, all its threads together."""
    text = Path(f"/proc/{process}/stat").read_text()
    user, system = text.rpartition(")")[2].split()[11:13]
    return (int(user) + int(system)) / os.sysconf("SC_CLK_TCK")
