"""Turns the simulator's Socket.IO telemetry into ROS topics and answers it with drive commands."""

import warnings

# At every start eventlet warns that it receives bug fixes only.
warnings.filterwarnings("ignore", message=r"\s*Eventlet is deprecated")
