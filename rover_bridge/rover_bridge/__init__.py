"""Turns the simulator's Socket.IO telemetry into ROS topics and answers it with drive commands."""

import os
import warnings

# The bridge looks up no names; eventlet's own DNS takes a third of the start-up time to import.
os.environ.setdefault("EVENTLET_NO_GREENDNS", "yes")
# At every start eventlet warns that it receives bug fixes only.
warnings.filterwarnings("ignore", message=r"\s*Eventlet is deprecated")
