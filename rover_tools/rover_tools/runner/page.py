"""The live page of a run: its node as a process, its address, and a browser on request."""

from __future__ import annotations

import socket
import time
import webbrowser
from pathlib import Path

from rover_dashboard.config import DashboardConfig
from rover_tools.output import note
from rover_tools.runner.graph import DASHBOARD, HOST, executable, free_port
from rover_tools.runner.run import Run

LISTENING_SECONDS = 20.0  # [s] for the node to start
POLL_SECONDS = 0.1  # [s]


def start_page(run: Run, parameters_file: Path, open_page: bool) -> str:
    """Start the node on its usual port, or on a free one where that is taken; the address.

    It keeps wall time, as its viewers do. With `open_page` a browser shows it once it listens.
    """
    port = free_port(DashboardConfig().port)
    command = [executable("rover_dashboard", DASHBOARD), "--ros-args"]
    command += ["--params-file", str(parameters_file), "-p", f"host:={HOST}", "-p", f"port:={port}"]
    run.processes.start(DASHBOARD, command)
    address = f"http://{HOST}:{port}/"
    note(f"watch it live: {address}")
    if open_page and _listens(run, port):
        webbrowser.open(address)
    return address


def _listens(run: Run, port: int) -> bool:
    """Whether the node accepts connections in time. Raises ProcessDiedError."""
    end = time.monotonic() + LISTENING_SECONDS
    while time.monotonic() < end:
        run.processes.check()
        with socket.socket() as probe:
            if probe.connect_ex((HOST, port)) == 0:
                return True
        time.sleep(POLL_SECONDS)
    note("the live page does not answer yet; open it by hand")
    return False
