"""The second robot: a TurtleBot3 Burger with two thermal sensors and a launcher."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class BurgerModel:
    """Its dimensions and limits; positions are those of REP-103 axes from base_footprint.

    Drive, lidar and speeds are from the maker's sheets; the launcher makes the body wider than
    bare, and a disc around the axle's middle stands for it in planning.
    """

    wheel_separation: float = 0.160  # [m]
    wheel_radius: float = 0.033  # [m]
    caster_x: float = -0.081  # [m]
    body_radius: float = 0.15  # [m] of the disc
    speed_max: float = 0.22  # [m/s] of the motors
    turn_max: float = 2.84  # [rad/s] of the motors
    cruise_speed: float = 0.20  # [m/s] that a mission drives
    cruise_turn: float = 1.8  # [rad/s]
    lidar_x: float = -0.032  # [m]
    lidar_z: float = 0.18  # [m]
    lidar_range_min: float = 0.16  # [m]
    lidar_range_max: float = 8.0  # [m]
    thermal_z: float = 0.12  # [m]
    thermal_field: float = 1.0471975511965976  # [rad] 60 degrees, in both directions
    thermal_pixels: int = 8  # in both directions


BURGER = BurgerModel()
