"""The second robot's node: its sensors to topics, velocities and launches to its maze.

Publishes scan, imu, odom, temperature_sensor_1 and _2, flywheel_status, /tf, /tf_static (latched),
/clock, /diagnostics, and in lockstep sensor_tick. Subscribes cmd_vel, flywheel, and mission_tick.
Services ~/pause and ~/resume (std_srvs/Trigger). Parameters: BurgerConfig.
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from geometry_msgs.msg import Twist as TwistMsg
from geometry_msgs.msg import TwistStamped
from nav_msgs.msg import Odometry
from rclpy.clock import Clock, ClockType
from rosgraph_msgs.msg import Clock as ClockMsg
from rover_interfaces.msg import SensorTick
from sensor_msgs.msg import Imu, LaserScan
from std_msgs.msg import Float32MultiArray, Header, Int32, String
from std_srvs.srv import Trigger
from tf2_msgs.msg import TFMessage

from burger_simulator import conversions
from burger_simulator.config import BurgerConfig
from burger_simulator.lockstep import Lockstep, Settling
from burger_simulator.simulation import START, TICK, BurgerSimulation
from burger_simulator.truth_file import TruthFile
from rover_common import nodes, topics
from rover_common.errors import RoverError
from rover_common.ros import qos
from rover_common.ros import sensor_conversions as sensors
from rover_common.ros.checked_node import CheckedNode
from rover_common.ros.conversions import stamp_of
from rover_common.ros.diagnostics import NodeDiagnostics
from rover_common.ros.parameters import declare_parameters
from rover_common.ros.runner import run_node
from rover_common.sensor_batches import Tick
from rover_common.sensor_types import SensorBatch, Twist

DONE = "done"  # what the launcher reports
SILENT = 0.7  # [s] of wall time without a report, after which a node of the team is silent
LOG_PERIOD = 5.0  # [s] between two lines about the same
SETTLED = 0.5  # [s] of wall time without another subscriber: all have found each other by then
LOOK, LOOK_FAST = 0.005, 0.0005  # [s] of wall time between two looks whether a tick is due
DRIVER, MISSION, LAUNCH = "driver", "mission", "flywheel"


class BurgerNode(CheckedNode):
    """Advances the simulation by the wall clock, or as its ticks are answered."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("burger_node", **kwargs)
        self._truth_file: TruthFile | None = None
        self._config = declare_parameters(self, BurgerConfig)
        maze = self._config.maze()
        self.simulation = BurgerSimulation(maze, self._config.seed, self._config)
        if self._config.truth_file:
            self._truth_file = TruthFile(Path(self._config.truth_file))
        self._paused = self._config.start_paused
        self._twist: Twist | None = None  # that came since the last tick
        self._launch = False
        self._due = -math.inf  # [s] of wall time, when the next tick is
        self._warned: dict[str, float] = {}  # [s] of wall time of the last line about it
        peers = {DRIVER, MISSION} if self._config.lockstep_with_mission else {DRIVER}
        self._lockstep = Lockstep(peers, self._config.answer_deadline)
        self._make_endpoints()
        self._settling = Settling(SETTLED)
        fast = self._config.rate == 0.0 and not self._config.lockstep
        self._timer = self.create_timer(
            LOOK_FAST if fast else LOOK,
            self._proceed,
            clock=Clock(clock_type=ClockType.STEADY_TIME),
        )
        self.get_logger().info(f"{maze.name}: {len(maze.sources)} heat sources")

    def destroy_node(self) -> None:
        """Close the file of the truth, then the node."""
        if self._truth_file is not None:
            self._truth_file.close()
        super().destroy_node()

    def _make_endpoints(self) -> None:
        publish, subscribe = self.create_publisher, self.create_subscription
        self._scan = publish(LaserScan, topics.SCAN, qos.SCAN)
        self._imu = publish(Imu, topics.IMU, qos.IMU)
        self._odometry = publish(Odometry, topics.ODOMETRY, qos.SENSOR)
        self._thermal = (
            publish(Float32MultiArray, topics.TEMPERATURE_1, qos.SENSOR),
            publish(Float32MultiArray, topics.TEMPERATURE_2, qos.SENSOR),
        )
        self._launched = publish(String, topics.FLYWHEEL_STATUS, qos.CONTROL)
        self._sensor_tick = publish(SensorTick, topics.SENSOR_TICK, qos.SENSOR)
        self._clock_publisher = publish(ClockMsg, "/clock", qos.CLOCK)
        self._tf = publish(TFMessage, "/tf", qos.TF)
        self._tf_static = publish(TFMessage, "/tf_static", qos.TF_STATIC)
        yaws = self._config.thermal_yaw_1, self._config.thermal_yaw_2
        self._tf_static.publish(conversions.static_transforms_of(START, yaws))
        self._driver = (
            subscribe(
                TwistStamped,
                topics.CMD_VEL,
                self._on_stamped_twist,
                qos.CONTROL,
                refused=lambda m: self._on_stamped_twist(TwistStamped(header=m.header)),
            )
            if self._config.stamped_cmd_vel or self._config.lockstep
            else subscribe(
                TwistMsg,
                topics.CMD_VEL,
                self._on_twist,
                qos.CONTROL,
                refused=lambda _: self._on_twist(TwistMsg()),
            )
        )
        self._mission = subscribe(Header, topics.MISSION_TICK, self._on_mission, qos.CONTROL)
        subscribe(Int32, topics.FLYWHEEL, self._on_flywheel, qos.CONTROL)
        self.create_service(Trigger, "~/pause", lambda _, r: self._pause(True, r))
        self.create_service(Trigger, "~/resume", lambda _, r: self._pause(False, r))
        self._diagnostics = NodeDiagnostics(self, self._peers())
        self._diagnostics.join(nodes.HEAT_TEAM, SILENT)

    def _peers(self) -> dict[str, Callable[[], bool]]:
        """Who is needed; in lockstep nothing begins without them."""

        def drives() -> bool:
            heard = self._heard()[: 4 if self._config.lockstep else 1]
            return self._driver.get_publisher_count() > 0 and min(heard) > 0

        def decides() -> bool:
            heard = self._heard()
            others = self._mission.get_publisher_count() > 0 and min(heard[4:]) > 0
            return others and min(heard[:4]) > 1

        return {DRIVER: drives} | ({MISSION: decides} if self._config.lockstep_with_mission else {})

    def _heard(self) -> tuple[int, ...]:
        """How many listen to what driver and mission need, and to what the mission alone does."""
        of_both = (self._scan, self._imu, self._odometry, self._sensor_tick)
        publishers = (*of_both, *self._thermal, self._launched)
        return tuple(publisher.get_subscription_count() for publisher in publishers)

    def _proceed(self) -> None:
        """Make the next tick, when it is due and the one before is answered."""
        now = time.monotonic()
        if self._paused or now < self._due:
            return
        if self._config.lockstep and not self._may_go_on(now):
            return
        rate = self._config.rate
        self._due = max(self._due + TICK / rate, now - TICK / rate) if rate else now
        batch = self.simulation.step(self._twist, self._launch)
        self._twist, self._launch = None, False
        self._lockstep.begin(batch.stamp, now)
        if self._truth_file is not None:
            self._truth_file.write(self.simulation.truth)
        self._publish(batch)

    def _may_go_on(self, now: float) -> bool:
        """In lockstep: all have been here for a while, and have answered or let it expire."""
        if not self._settling.done:
            missing = [name for name, connected in self._peers().items() if not connected()]
            if missing:
                self._warn("peers", f"waiting for {', '.join(missing)}")
            if missing or not self._settling.settled(self._heard(), now):
                return False
        missing = self._lockstep.missing
        if missing and not self._lockstep.expired(now):
            return False
        if missing:
            self._diagnostics.counts["answers_missing"] += 1
            self._warn("answers", f"no answer of {', '.join(missing)} in time: standing")
            self._twist = Twist()
        return True

    def _publish(self, batch: SensorBatch) -> None:
        """The clock comes first, the tick that ends the batch last."""
        self._clock_publisher.publish(conversions.clock_of(batch.stamp))
        for imu in batch.imus:
            self._imu.publish(sensors.imu_message_of(imu))
        for odometry in batch.odometry:
            self._odometry.publish(sensors.wheel_odometry_message_of(odometry))
            self._tf.publish(conversions.body_transform_of(odometry))
        for scan in batch.scans:
            self._scan.publish(sensors.laser_scan_message_of(scan))
        for frame in batch.thermal:
            self._thermal[frame.sensor - 1].publish(sensors.thermal_message_of(frame))
        for _ in range(batch.launches_done):
            self._launched.publish(String(data=DONE))
        if self._config.lockstep:
            self._sensor_tick.publish(sensors.tick_message_of(Tick.of(batch)))

    def _on_stamped_twist(self, message: TwistStamped) -> None:
        if self._config.lockstep and not self._answered(DRIVER, message.header):
            return
        self._on_twist(message.twist)

    def _on_twist(self, message: TwistMsg) -> None:
        self._twist = sensors.twist_of(message)
        self._proceed_in_lockstep()

    def _on_mission(self, message: Header) -> None:
        if self._answered(MISSION, message):
            if message.frame_id == LAUNCH and not self._launch:
                self._lockstep.expect(LAUNCH)
            self._proceed_in_lockstep()

    def _on_flywheel(self, message: Int32) -> None:
        self._launch = self._launch or message.data > 0
        self._lockstep.arrived(LAUNCH)
        self._proceed_in_lockstep()

    def _answered(self, peer: str, header: Header) -> bool:
        if self._lockstep.answer(peer, stamp_of(header.stamp)):
            return True
        self._diagnostics.counts["answers_late"] += 1
        return False

    def _proceed_in_lockstep(self) -> None:
        """At once, where the timer would lose a millisecond."""
        if self._config.lockstep and not self._lockstep.missing:
            self._proceed()

    def _pause(self, paused: bool, response: Trigger.Response) -> Trigger.Response:
        self._paused = paused
        response.success = True
        response.message = "paused" if paused else "running"
        return response

    def _warn(self, about: str, text: str) -> None:
        """Log a line, unless one about the same was logged within LOG_PERIOD."""
        now = time.monotonic()
        if now - self._warned.get(about, -LOG_PERIOD) >= LOG_PERIOD:
            self._warned[about] = now
            self.get_logger().warning(text)


def main() -> None:
    """Entry point of `ros2 run burger_simulator burger_node`."""
    try:
        run_node(BurgerNode)
    except (RoverError, OSError) as error:  # a maze or a file that cannot be used
        sys.exit(f"burger_node: {error}")
