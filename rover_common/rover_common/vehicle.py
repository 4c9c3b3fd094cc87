"""Limits of the simulator's vehicle that more than one package needs."""

import math

MAX_STEERING = math.radians(15.0)  # [rad] either side
MAX_SPEED = 5.0  # [m/s] forward; the simulator clamps there
MAX_REVERSE_SPEED = 2.0  # [m/s] while throttle < 0
WHEELBASE = 0.7221  # [m]
TURN_IN_PLACE_BELOW = math.sqrt(0.1)  # [m/s] with no throttle and no brake
TURN_IN_PLACE_RATE = 3.0  # [1/s] yaw rate per steering angle: 45 deg/s at full steering
PICKUP_SECONDS = 10.0  # [s] the arm's whole sequence
# The arm reaches a sample whose centre is within ARM_RADIUS of the point ARM_FORWARD ahead.
ARM_FORWARD = 0.8435  # [m]
ARM_RADIUS = 0.55  # [m]
START_X, START_Y = 99.67, 85.589  # [m] map frame, in the original canyon
