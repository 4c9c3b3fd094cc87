"""Names of the coordinate frames (REP-105)."""

MAP = "map"
ODOM = "odom"  # the simulator's pose is exact, so map -> odom is the identity
BASE = "base_link"
CAMERA = "camera_link"  # x forward, y left, z up
CAMERA_OPTICAL = "camera_optical_frame"  # x right, y down, z forward
