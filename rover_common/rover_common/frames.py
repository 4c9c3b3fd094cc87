"""Names of the coordinate frames (REP-105)."""

MAP = "map"
ODOM = "odom"  # the simulator's pose is exact, so map -> odom is the identity
BASE = "base_link"
BASE_FOOTPRINT = "base_footprint"  # of the second robot: on the ground below base_link
BODIES = (BASE_FOOTPRINT, BASE)  # which of them a robot places in odom
BASE_SCAN = "base_scan"
IMU = "imu_link"
THERMAL = ("thermal_1_link", "thermal_2_link")  # x where the sensor looks
CAMERA = "camera_link"  # x forward, y left, z up
CAMERA_OPTICAL = "camera_optical_frame"  # x right, y down, z forward
