"""The heat node: what the second robot's sensors say to goals, velocities and launches.

Subscribes scan, imu, odom, temperature_sensor_1 and _2, flywheel_status, map (latched), /tf,
/diagnostics, in lockstep sensor_tick and navigation_tick. Publishes hazard_map, heat_sources,
heat_state (latched), heat_markers (while watched), flywheel, cmd_vel (while the mission itself
drives), /diagnostics, in lockstep mission_tick. Client of the action navigate_to_pose
(nav2_msgs/NavigateToPose); serves ~/run_mission (rover_interfaces/RunHeatMission) and ~/start,
~/pause, ~/resume, ~/reset (std_srvs/Trigger). Parameters: HeatNodeConfig, InputLimits.
"""

from __future__ import annotations

from functools import partial
from typing import Any

from nav_msgs.msg import OccupancyGrid
from rclpy.clock import Clock, ClockType
from std_msgs.msg import Header, Int32
from std_srvs.srv import Trigger

from rover_common import nodes, topics
from rover_common.frames import BurgerFrameConfig
from rover_common.ros import qos
from rover_common.ros.checked_node import CheckedNode
from rover_common.ros.conversions import grid_message_of, header_of
from rover_common.ros.diagnostics import NodeDiagnostics
from rover_common.ros.endpoint_watch import EndpointWatch
from rover_common.ros.parameters import declare_parameters
from rover_common.ros.runner import run_node
from rover_common.ros.velocity import VelocityPublisher
from rover_common.sensor_types import SensorBatch
from rover_common.types import GridMap
from rover_decision.types import Request
from rover_heat.frames import FrameAssembler
from rover_heat.inputs import APART_WARNING
from rover_heat.mission import make_core
from rover_heat.mission.mission import HeatMission
from rover_heat.mission.ownership import STAND
from rover_heat.node_config import HeatNodeConfig
from rover_heat.node_lockstep import HeatLockstep
from rover_heat.node_reports import HeatReports
from rover_heat.node_sensors import HeatSensors
from rover_heat.node_state import KeptMission
from rover_heat.ramp.hazards import NO_HAZARDS
from rover_heat.thermal.sensing import SENSORS
from rover_heat.types import HeatDecision
from rover_navigation.node_client import ActionNavigator

PERIOD = 0.05  # [s] between two ticks
LOOK = 0.2  # [s] of wall time between two looks at the peers
SPIN = 50  # what the launcher takes as its signal
REQUESTS = (Request.START, Request.PAUSE, Request.RESUME, Request.RESET)


class HeatNode(CheckedNode):
    """Collects what the sensors say, steps the mission, publishes what it decided."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("heat_node", **kwargs)
        self._frame_ids = declare_parameters(self, BurgerFrameConfig).frames()
        self._config = config = declare_parameters(self, HeatNodeConfig)
        self._lockstep: HeatLockstep | None = None
        map_frame = self._frame_ids.map
        self._navigator = ActionNavigator(self, self._on_heard, map_frame=map_frame)
        self._core = make_core(config, self._navigator, config.lockstep)
        self._sensors = HeatSensors(self, config.lockstep, self._frame_ids, self._on_heard)
        self._frames = FrameAssembler(config, self._sensors.poses)
        self._kept = KeptMission(
            self, config, self._core, self._navigator, self._sensors, self._frames
        )
        self._grid: GridMap | None = None  # that the mission has
        self._hazards = NO_HAZARDS  # that were sent
        self._decision: HeatDecision | None = None  # of the tick at hand
        self._hazard_map = self.create_publisher(OccupancyGrid, topics.HAZARD_MAP, qos.LATCHED)
        self._flywheel = self.create_publisher(Int32, topics.FLYWHEEL, qos.CONTROL)
        self._velocity = VelocityPublisher(self, config.stamped_cmd_vel, self._frame_ids)
        self._reports = HeatReports(self, self._core, self._frame_ids)
        for request in REQUESTS:
            self.create_service(Trigger, f"~/{request.value}", partial(self._on_request, request))
        subscriptions = list(self._sensors.subscriptions)
        self._mission_tick: Any = None
        if config.lockstep:
            self._lockstep = HeatLockstep(
                self, self._sensors, self._navigator, self._core.ready, self._decide, self._answer
            )
            subscriptions.append(self._lockstep.subscription)
        self._diagnostics = NodeDiagnostics(self, self._peers(), self._sensors.inputs)
        self._diagnostics.join(nodes.HEAT_TEAM, self._sensors.limits.input_error_age)
        self._watch = EndpointWatch(self, self._diagnostics, subscriptions)
        self._look_timer = self.create_timer(
            LOOK, self._look, clock=Clock(clock_type=ClockType.STEADY_TIME)
        )
        if not config.lockstep:
            self._timer = self.create_timer(PERIOD, self._on_timer)

    def destroy_node(self) -> None:
        """End the action's goal, save the last state, end threads and client, then the node."""
        if hasattr(self, "_reports"):
            self._reports.action.destroy()
        if hasattr(self, "_kept"):
            self._kept.close()
        if hasattr(self, "_core"):
            self._core.close()
            self._navigator.destroy()
        super().destroy_node()

    def _peers(self) -> dict[str, Any]:
        """Who is needed."""
        peers = {
            sub.topic_name.lstrip("/"): lambda sub=sub: sub.get_publisher_count() > 0
            for sub in self._sensors.subscriptions
        }
        return {
            **peers,
            "navigator": lambda: self._navigator.is_present,
            "robot": lambda: self._velocity.connected,
        }

    def _look(self) -> None:
        """In lockstep it is there for the simulator when all that it needs is there."""
        if self._lockstep is None:
            return
        if self._mission_tick is None:
            heard = self._hazard_map.get_subscription_count() > 0
            speaks = self._lockstep.subscription.get_publisher_count() > 0
            if heard and speaks and all(is_here() for is_here in self._peers().values()):
                kind, topic = Header, topics.MISSION_TICK
                self._mission_tick = self.create_publisher(kind, topic, qos.CONTROL)
        self._lockstep.check_patience()
        self._diagnostics.counts["navigator_missing"] = self._lockstep.missing

    def _on_request(
        self, request: Request, _: Trigger.Request, response: Trigger.Response
    ) -> Trigger.Response:
        response.success = self._core.request(request)
        response.message = f"{request.value}: {self._core.state.name}"
        self.get_logger().info(response.message)
        self._reports.action.settle()
        return response

    def _on_heard(self) -> None:
        if self._lockstep is not None:
            self._lockstep.work()

    def _on_timer(self) -> None:
        now = self.get_clock().now().nanoseconds
        if now > 0:  # the simulated clock has begun
            batch = self._sensors.collector.take(now)
            self._decide(batch)
            self._answer(batch.stamp, False)

    def _decide(self, batch: SensorBatch) -> None:
        """One tick of the mission."""
        with self._diagnostics.ticks:
            self._step(batch)

    def _step(self, batch: SensorBatch) -> None:
        stamp = batch.stamp
        self._navigator.update(stamp)
        grid, new_map = self._sensors.grid, self._sensors.grid is not self._grid
        if grid is not None and new_map:
            self._grid = grid
            self._frames.give_map(grid)
        self._kept.follow(batch)
        frame = self._frames.frame(batch)
        if grid is not None:
            self._core.give_map(stamp, grid)
        self._decision = decision = self._core.step(frame)
        if decision.new_run:
            self._frames.begin_run(stamp)
        if grid is not None and (new_map or decision.hazards != self._hazards):
            self._send_hazards(stamp, grid, decision)
        self._kept.keep(decision)
        self._reports.tell(stamp, frame.run, decision)
        self._diagnose()

    def _send_hazards(self, stamp: int, grid: GridMap, decision: HeatDecision) -> None:
        self._hazards = decision.hazards
        drawn = decision.hazards.drawn_into(grid)
        self._hazard_map.publish(grid_message_of(stamp, drawn, self._frame_ids))
        if self._lockstep is not None:
            self._lockstep.hazards = stamp

    def _answer(self, stamp: int, navigator_drives: bool) -> None:
        """Do what was decided. In lockstep a tick has one driver, and standing is an answer too."""
        decision = self._decision
        assert decision is not None
        twist = decision.twist
        if self._lockstep is not None:
            twist = None if navigator_drives else twist or STAND
        if twist is not None:
            self._velocity.publish(stamp, twist)
        if decision.launch:
            self.get_logger().info("launch")
            self._flywheel.publish(Int32(data=SPIN))
        if self._mission_tick is not None:
            self._mission_tick.publish(header_of(stamp, topics.FLYWHEEL if decision.launch else ""))

    def _diagnose(self) -> None:
        mission = self._core.mission
        assert isinstance(mission, HeatMission)
        parts = mission.parts
        counts, warn = self._diagnostics.counts, self._diagnostics.set_warning
        counts["ticks"] += 1
        self._diagnostics.state = self._core.state.name
        counts["thermal_dropped"] = self._sensors.dropped + sum(parts.sensing.dropped.values())
        counts["plans_failed"] = self._core.plan_failures
        apart = parts.inputs.apart
        warn("clock", f"stamps {apart:.1f} s from the clock" if apart > APART_WARNING else "")
        silent = [str(number) for number in SENSORS if number not in parts.sensing.alive]
        warn("thermal", f"no thermal sensor {' and '.join(silent)}" if silent else "")
        missing = parts.inputs.missing
        warn("inputs", f"no {', no '.join(missing)}" if missing else "")


def main() -> None:
    """Entry point of `ros2 run rover_heat heat_node`."""
    run_node(HeatNode, keeps_maps=True)
