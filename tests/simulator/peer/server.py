"""The least autonomy server, as one is written for the Unity simulator.

    python server.py FILE_DESCRIPTOR COUNT RECORD

Serves on a listening socket that it inherits, answers each telemetry with a `data` event of its
own steering angle, and ends after COUNT telemetries. RECORD gets one JSON line for each event, in
their order: ["telemetry", {...}] or ["data", "steering angle"].
"""

from __future__ import annotations

import json
import socket
import sys
from itertools import count
from pathlib import Path
from typing import Any

import eventlet
import eventlet.event
import eventlet.greenio
import eventlet.wsgi
import socketio


def main() -> None:
    descriptor, wanted, record = int(sys.argv[1]), int(sys.argv[2]), Path(sys.argv[3])
    server = socketio.Server(async_mode="eventlet")
    done = eventlet.event.Event()
    commands, telemetries = count(), count(1)

    with record.open("w") as lines:

        def note(*line: Any) -> None:
            lines.write(json.dumps(line) + "\n")

        def command() -> None:
            # Each of its own, so that a telemetry tells which of them it answers.
            steering = f"{next(commands) % 3000 / 100 - 15:.4f}"
            note("data", steering)
            drive = {"steering_angle": steering, "throttle": "0.2", "brake": "0"}
            server.emit("data", drive | {"inset_image1": "", "inset_image2": ""})

        @server.on("connect")
        def connect(sid: str, environ: dict[str, Any]) -> None:
            command()  # unasked, as such servers do
            server.emit("get_samples", {})  # the simulator knows no such event

        @server.on("telemetry")
        def telemetry(sid: str, data: dict[str, Any]) -> None:
            note("telemetry", data)
            if next(telemetries) < wanted:
                command()
            elif not done.ready():
                done.send()

        listener = eventlet.greenio.GreenSocket(socket.socket(fileno=descriptor))
        application = socketio.WSGIApp(server)
        eventlet.spawn(eventlet.wsgi.server, listener, application, log_output=False)
        done.wait()


if __name__ == "__main__":
    main()
