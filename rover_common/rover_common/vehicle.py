"""The facts of the simulator's vehicle: the one place where they stand.

Sources: *constant*, a constant of the original simulator; *measured*, from recordings of it;
*derived*, calculated from constants; *chosen*, a margin of this project's own.
"""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True)
class VehicleModel:
    """A rover with four driven wheels, two of them steered, and an arm at its front.

    Distances are those in base_link: from its origin, which lies between the axles.
    """

    # Steering command and wheels
    max_steering: float  # [rad] of a steering command, to either side
    wheelbase: float  # [m] between the axles
    front_axle: float  # [m] ahead of the origin
    rear_axle: float  # [m] behind the origin
    track: float  # [m] between the left and the right wheels
    wheel_at_rest: float  # [rad] of the front wheels at max_steering, standing
    wheel_at_max_speed: float  # [rad] the same at max_speed; linear in the speed between
    yaw_factor: float  # yaw rate per kinematic one, speed * tan(wheel) / wheelbase
    # Turn in place: steering without throttle and brake, from a speed below the limit
    turn_in_place_below: float  # [m/s]
    turn_in_place_rate: float  # [1/s] yaw rate per steering angle

    # Speed
    max_speed: float  # [m/s] forward
    max_reverse_speed: float  # [m/s] while throttle < 0
    full_brake_deceleration: float  # [m/s^2] at brake 1
    least_reported_speed: float  # [m/s] telemetry says 0 below
    standing_speed: float  # [m/s] at which the rover counts as standing

    # Arm: reaches a sample whose centre is within arm_radius of the point arm_forward ahead
    arm_forward: float  # [m]
    arm_radius: float  # [m] for samples of every size
    arm_radius_median: float  # [m] for a sample of middle size
    pickup_seconds: float  # [s] the whole sequence
    pickup_speed: float  # [m/s] a pickup is sent at this speed or below

    # Body: the rectangle that the wheels stand on
    body_front: float  # [m] ahead of the origin
    body_rear: float  # [m] behind the origin
    body_half_width: float  # [m] to either side
    mass_depth: float  # [m] centre of mass below the origin
    suspension_travel: float  # [m] of a wheel, from stop to stop
    # Ground this near to the origin may be outside of the camera's view
    camera_blind_radius: float  # [m]

    @property
    def pitch_stop(self) -> float:
        """Most [rad] that the suspension lets the body pitch against the ground, either way."""
        return math.atan(self.suspension_travel / self.wheelbase)

    @property
    def roll_stop(self) -> float:
        """Most [rad] that the suspension lets the body roll against the ground, either way."""
        return math.atan(self.suspension_travel / self.track)

    def wheel_limit(self, speed: float) -> float:
        """Angle [rad] of the front wheels at max_steering and a speed [m/s] of either sign."""
        share = min(1.0, abs(speed) / self.max_speed)
        return self.wheel_at_rest + share * (self.wheel_at_max_speed - self.wheel_at_rest)


ROVER = VehicleModel(
    max_steering=math.radians(15.0),  # constant
    wheelbase=0.7221,  # constant
    front_axle=0.3861,  # constant
    rear_axle=0.336,  # constant
    track=0.792,  # constant
    wheel_at_rest=math.radians(15.0),  # constant
    wheel_at_max_speed=math.radians(5.0),  # constant
    yaw_factor=0.95,  # measured: 0.92 coasting, 0.96 at full throttle
    turn_in_place_below=math.sqrt(0.1),  # constant: the square of the speed is compared with 0.1
    turn_in_place_rate=3.0,  # constant, 45 deg/s at max_steering; measured within 1 %
    max_speed=5.0,  # constant: clamped there
    max_reverse_speed=2.0,  # constant: clamped there
    full_brake_deceleration=2.5,  # measured: 2.0 to 3.5, median 2.6
    least_reported_speed=0.01,  # constant
    # chosen: after a stop the speed oscillates, by up to 0.15 m/s, for 0.5 to 3.5 s (measured)
    standing_speed=0.1,
    arm_forward=0.8435,  # constant
    arm_radius=0.55,  # derived: 0.55 to 0.60 by the sample's size
    arm_radius_median=0.57,  # derived
    pickup_seconds=10.0,  # constant: six phases; measured 10.01 and 10.08
    # chosen: so slowly a rover still has its sample in reach when the arm starts
    pickup_speed=0.2,
    body_front=0.535,  # derived: front axle at 0.3861, wheels of radius 0.1485
    body_rear=0.485,  # derived: rear axle at -0.336
    body_half_width=0.44,  # derived: wheels at 0.396, and half their width
    mass_depth=1.0,  # constant
    # constant: the stops that follow, 1.31 degrees of pitch and 1.19 of roll, are where recorded
    # tilts pile up on flat ground
    suspension_travel=0.0165,
    camera_blind_radius=1.2,  # chosen: the ground ahead is seen from 0.76 m on, to the sides later
)
