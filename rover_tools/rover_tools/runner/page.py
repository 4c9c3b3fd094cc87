"""The live page of a run: its node as a process, its address, and a browser on request."""

from __future__ import annotations

import socket
import time
import webbrowser
from pathlib import Path
from typing import Any

from rover_common.errors import RoverError
from rover_dashboard.config import DashboardConfig
from rover_tools.output import note
from rover_tools.runner.graph import DASHBOARD, HOST, free_port, node_command
from rover_tools.runner.run import ProcessRun

LISTENING_SECONDS = 30.0  # [s] for the node to start
POLL_SECONDS = 0.1  # [s]


class PageError(RoverError):
    """The live page did not start in time."""


def start_page(run: ProcessRun[Any], parameters_file: Path, open_page: bool) -> str:
    """Start the node on its usual port, or on a free one where that is taken; the address.

    It keeps wall time, as its viewers do. Once it listens, the address is printed, and a browser
    shows it with `open_page`. Raises PageError or ProcessDiedError.
    """
    port = free_port(DashboardConfig().port)
    values = {"host": HOST, "port": port}
    run.processes.start(
        DASHBOARD, node_command("rover_dashboard", DASHBOARD, parameters_file, values)
    )
    address = f"http://{HOST}:{port}/"
    _wait_listening(run, port)
    run.processes.make_optional(DASHBOARD)  # a mission must not end with its page
    note(f"watch it live: {address}")
    if open_page:
        webbrowser.open(address)
    return address


def _wait_listening(run: ProcessRun[Any], port: int) -> None:
    end = time.monotonic() + LISTENING_SECONDS
    while True:
        run.processes.check()
        with socket.socket() as probe:
            if probe.connect_ex((HOST, port)) == 0:
                return
        if time.monotonic() > end:
            raise PageError(f"the live page did not start within {LISTENING_SECONDS:.0f} s")
        time.sleep(POLL_SECONDS)
