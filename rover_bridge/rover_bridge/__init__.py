"""Turns the simulator's Socket.IO telemetry into ROS topics and answers it with drive commands."""
