"""The second robot's node: its sensors to topics, velocities and launches to its maze.

Publishes scan, imu, odom, temperature_sensor_1 and _2, flywheel_status, /tf, /tf_static (latched),
/clock, /diagnostics, and in lockstep sensor_tick. Subscribes cmd_vel, flywheel, and mission_tick.
Services ~/pause and ~/resume (std_srvs/Trigger), and those of simulation_interfaces. A lifecycle
node. Parameters: BurgerConfig.
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
from rclpy.clock import Clock, ClockType
from std_msgs.msg import Header, Int32
from std_srvs.srv import Trigger

from burger_simulator.config import BurgerConfig, SensorFrameConfig
from burger_simulator.lockstep import SETTLED, Lockstep, Settling
from burger_simulator.node_publishers import SensorPublishers
from burger_simulator.simulation import TICK, BurgerSimulation
from burger_simulator.truth_file import TruthFile
from rover_common import nodes, topics
from rover_common.errors import RoverError
from rover_common.geometry import Pose
from rover_common.ros import qos
from rover_common.ros import sensor_conversions as sensors
from rover_common.ros.conversions import stamp_of
from rover_common.ros.diagnostics import NodeDiagnostics
from rover_common.ros.lifecycle import ManagedNode
from rover_common.ros.notices import Notices
from rover_common.ros.parameters import declare_parameters
from rover_common.ros.runner import run_node
from rover_common.ros.simulator_control import ControlError, SimulatorControl
from rover_common.sensor_types import Twist

SILENT = 0.7  # [s] of wall time without a report, after which a node of the team is silent
LOOK, LOOK_FAST = 0.005, 0.0005  # [s] of wall time between two looks whether a tick is due
ENTITY, WORLD = "burger", "world"  # of the services
DRIVER, MISSION, LAUNCH = "driver", "mission", "flywheel"


class BurgerNode(ManagedNode):
    """Advances the simulation by the wall clock, or as its ticks are answered."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("burger_node", **kwargs)
        self._truth_file: TruthFile | None = None
        self.bring_up(self._prepare)

    def _prepare(self) -> None:
        self._frames = declare_parameters(self, SensorFrameConfig).frames()
        self._config = declare_parameters(self, BurgerConfig, self._on_config)
        self._maze = maze = self._config.maze()
        self.simulation = BurgerSimulation(maze, self._config.seed, self._config)
        if self._config.truth_file:
            self._truth_file = TruthFile(Path(self._config.truth_file))
        self._paused = self._config.start_paused
        self._twist: Twist | None = None  # that came since the last tick
        self._launch = False
        self._due = -math.inf  # [s] of wall time, when the next tick is
        self._notices = Notices(self)
        peers = {DRIVER, MISSION} if self._config.lockstep_with_mission else {DRIVER}
        self._lockstep = Lockstep(peers, self._config.answer_deadline)
        self._make_endpoints()
        self._settling = Settling(SETTLED)
        self._timer = self.create_timer(
            self._look_period(), self._proceed, clock=Clock(clock_type=ClockType.STEADY_TIME)
        )
        self.get_logger().info(f"{maze.name}: {len(maze.sources)} heat sources")

    def destroy_node(self) -> None:
        """Close the file of the truth, then the node."""
        if self._truth_file is not None:
            self._truth_file.close()
        super().destroy_node()

    def _look_period(self) -> float:
        """[s] of wall time between two looks whether a tick is due."""
        fast = self._config.rate == 0.0 and not self._config.lockstep
        return LOOK_FAST if fast else LOOK

    def _on_config(self, config: BurgerConfig) -> None:
        self._config = config
        self._timer.timer_period_ns = round(self._look_period() * 1e9)

    def _make_endpoints(self) -> None:
        subscribe = self.create_subscription
        self._topics = SensorPublishers(self, self._config, self._frames)
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
        self.create_service(Trigger, "~/pause", lambda _, r: self._answer_pause(True, r))
        self.create_service(Trigger, "~/resume", lambda _, r: self._answer_pause(False, r))
        SimulatorControl(self, self, ENTITY, WORLD)
        self._diagnostics = NodeDiagnostics(self, self._peers())
        self._diagnostics.join(nodes.HEAT_TEAM, SILENT)

    def _peers(self) -> dict[str, Callable[[], bool]]:
        """Who is needed; in lockstep nothing begins without them."""

        def drives() -> bool:
            heard = self._topics.heard()[: 4 if self._config.lockstep else 1]
            return self._driver.get_publisher_count() > 0 and min(heard) > 0

        def decides() -> bool:
            heard = self._topics.heard()
            others = self._mission.get_publisher_count() > 0 and min(heard[4:]) > 0
            return others and min(heard[:4]) > 1

        return {DRIVER: drives} | ({MISSION: decides} if self._config.lockstep_with_mission else {})

    def _proceed(self) -> None:
        """Make the next tick, when it is due and the one before is answered."""
        now = time.monotonic()
        if self.paused or now < self._due:
            return
        if self._config.lockstep and not self._may_go_on(now):
            return
        rate = self._config.rate
        self._due = max(self._due + TICK / rate, now - TICK / rate) if rate else now
        self._make_tick(now)

    def _make_tick(self, now: float) -> None:
        """`now` [s] of wall time."""
        batch = self.simulation.step(self._twist, self._launch)
        self._twist, self._launch = None, False
        self._lockstep.begin(batch.stamp, now)
        if self._truth_file is not None:
            self._truth_file.write(self.simulation.truth)
        self._topics.publish(batch)

    def _may_go_on(self, now: float) -> bool:
        """In lockstep: all have been here for a while, and have answered or let it expire."""
        self._lockstep.follow(self._mission.get_publisher_count(), now)
        if not self._settling.done:
            missing = [name for name, connected in self._peers().items() if not connected()]
            if missing:
                waiting = f"waiting for {', '.join(missing)}"
                self._notices.warn(waiting, waiting)
            if missing or not self._settling.settled(self._topics.heard(), now):
                return False
        missing = self._lockstep.missing
        if missing and not self._lockstep.expired(now):
            return False
        if missing:
            self._diagnostics.counts["answers_missing"] += 1
            self._notices.warn("answers", f"no answer of {', '.join(missing)} in time: standing")
            self._twist = Twist()
        return True

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

    @property
    def paused(self) -> bool:
        """Whether time stands still."""
        return self._paused or not self.active

    def pause(self, paused: bool) -> None:
        """Let time stand still, or pass."""
        if not self.active:
            raise ControlError("the node is not active")
        self._paused = paused

    def step(self, count: int) -> None:
        """So many ticks, while it is paused."""
        if self._config.lockstep:
            raise ControlError("in lockstep the ticks wait for their answers")
        for _ in range(count):
            self._make_tick(time.monotonic())

    def reset(self) -> None:
        """The robot stands at the start again, as it was switched on; the clock goes on."""
        began = self.simulation.stamp
        self.simulation = BurgerSimulation(self._maze, self._config.seed, self._config, began)
        self._twist, self._launch = None, False
        self._topics.switch_on(began)

    def place(self, pose: Pose) -> None:
        """On level ground; its odometry does not notice."""
        if not self.simulation.place(pose):
            raise ControlError(f"({pose.x:.2f}, {pose.y:.2f}) m is not free")

    def _answer_pause(self, paused: bool, response: Trigger.Response) -> Trigger.Response:
        self._paused = paused
        response.success = True
        response.message = "paused" if paused else "running"
        return response


def main() -> None:
    """Entry point of `ros2 run burger_simulator burger_node`."""
    try:
        run_node(BurgerNode)
    except (RoverError, OSError) as error:  # a maze or a file that cannot be used
        sys.exit(f"burger_node: {error}")
