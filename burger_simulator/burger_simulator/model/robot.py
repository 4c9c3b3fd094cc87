"""The robot as a body of the model: chassis, two driven wheels, ball caster, sensor frames.

Its masses and places are those of the maker's model file unless a comment says otherwise.
"""

from __future__ import annotations

from typing import Any
from xml.etree.ElementTree import Element, SubElement

from burger_simulator.world.maze import SensorErrors
from rover_common.burger import BURGER
from rover_common.geometry import Pose, quaternion_from_pose

CHASSIS_MASS = 1.28  # [kg] loaded, without the wheels: 1.35 in all
WHEEL_MASS = 0.0285  # [kg]
MASS_X, MASS_Z = -0.032, 0.080  # [m] of the chassis's middle of mass
INERTIA = (0.010, 0.010, 0.012)  # [kg m^2] of a box of that mass, 0.25 m wide and 0.17 m high
CHASSIS_BOTTOM, CHASSIS_TOP = 0.035, 0.165  # [m] below the lidar's beam
BOX = (0.135, 0.150)  # [m] half length and half width of the body with its launcher
CASTER_RADIUS, CASTER_Z = 0.005, 0.006  # [m] 1 mm above the ground, so that the nose is up a little
DROP = 0.01  # [m] to the ground below the axle: less than the caster is in it on a slope
IMU_X, IMU_Z = -0.032, 0.078  # [m]

RUBBER = "0.8 0.005 0.0001"  # friction of the wheels: sliding, torsional, rolling
STEEL = "0.02 0.005 0.0001"  # of the ball, which rolls
STALL_TORQUE = 1.4  # [N m] of the XL430-W250 motor at 11.1 V
# The motor's speed loop holds the angle to which the speed adds up: it loses none on a slope, and
# stands on it. Damped critically, and slow enough that a step from top speed to zero does not lift
# the caster: its deceleration stays below g * 0.032 m / 0.080 m.
DAMPING = STALL_TORQUE / 5.97  # [N m s/rad] its no-load speed of 57 turns a minute
STIFFNESS = DAMPING / 0.06  # [N m/rad]
# [kg m^2] of a rotor behind gears of 258.5 to 1, assumed. Without it the wheel is so light that the
# solver, to which the servo's stiffness is not known, lets it slip.
ARMATURE = 0.003
GROUP = 1  # of the robot's geoms, so that rays can leave them out


def add_robot(world: Element, start: Pose, ground: float, errors: SensorErrors, box: bool) -> None:
    """Dropped on ground so high [m]; `box`: a body with corners instead of the disc."""
    base = SubElement(
        world, "body", name="base", pos=f"{start.x} {start.y} {ground + DROP}", quat=wxyz(start)
    )
    SubElement(base, "freejoint", name="free")
    SubElement(
        base, "inertial", pos=f"{MASS_X} 0 {MASS_Z}", mass=str(CHASSIS_MASS),
        diaginertia=" ".join(map(str, INERTIA)),
    )  # fmt: skip
    _chassis(base, box)
    SubElement(
        base, "geom", name="caster", type="sphere", size=str(CASTER_RADIUS), friction=STEEL,
        pos=f"{BURGER.caster_x} 0 {CASTER_Z}", priority="2", group=str(GROUP),
    )  # fmt: skip
    half = BURGER.wheel_separation * errors.wheel_separation_scale / 2
    radius = BURGER.wheel_radius * errors.wheel_radius_scale
    _wheel(base, "left", half, radius)
    _wheel(base, "right", -half, radius)
    tilt = Pose(0.0, 0.0, 0.0, errors.level_pitch, errors.level_roll)
    SubElement(base, "site", name="imu", pos=f"{IMU_X} 0 {IMU_Z}", quat=wxyz(tilt))


def add_motors(model: Element) -> None:
    """Speed servos with a torque limit, and the inertial unit's sensors."""
    actuators = SubElement(model, "actuator")
    for side in ("left", "right"):
        SubElement(
            actuators, "general", name=side, joint=side, dyntype="integrator",
            gainprm=str(STIFFNESS), biastype="affine", biasprm=f"0 {-STIFFNESS} {-DAMPING}",
            forcerange=f"{-STALL_TORQUE} {STALL_TORQUE}",
        )  # fmt: skip
    sensors = SubElement(model, "sensor")
    SubElement(sensors, "gyro", name="gyro", site="imu")
    SubElement(sensors, "accelerometer", name="accelerometer", site="imu")


def _chassis(base: Element, box: bool) -> None:
    half = (CHASSIS_TOP - CHASSIS_BOTTOM) / 2
    shape: dict[str, Any] = (
        {"type": "box", "size": f"{BOX[0]} {BOX[1]} {half}"}
        if box
        else {"type": "cylinder", "size": f"{BURGER.body_radius} {half}"}
    )
    SubElement(
        base, "geom", name="chassis", pos=f"0 0 {CHASSIS_BOTTOM + half}", group=str(GROUP), **shape
    )


def _wheel(base: Element, name: str, y: float, radius: float) -> None:
    """A sphere: it touches the ground in one point, so the wheels' distance is an exact one."""
    wheel = SubElement(base, "body", name=name, pos=f"0 {y} {radius}")
    SubElement(wheel, "joint", name=name, axis="0 1 0", armature=str(ARMATURE))
    SubElement(
        wheel, "geom", name=name, type="sphere", size=str(radius), mass=str(WHEEL_MASS),
        friction=RUBBER, priority="1", group=str(GROUP),
    )  # fmt: skip


def wxyz(pose: Pose) -> str:
    """The pose's rotation, in the order of the model's attributes."""
    x, y, z, w = quaternion_from_pose(pose)
    return f"{w} {x} {y} {z}"
