"""Turns the simulator's Socket.IO telemetry into ROS topics and answers it with drive commands."""

import warnings

# eventlet tells at every start that it gets bug fixes only. That is known, and enough here.
warnings.filterwarnings("ignore", message=r"\s*Eventlet is deprecated")
