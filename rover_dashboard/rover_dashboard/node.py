"""The dashboard node: serves a live page of the mission.

Subscribes odom and rover_status (joined by stamp), mission_state and bridge_state all the time, and
camera/image_raw, vision_image, worldmap, plan, mission_markers and cmd_drive while somebody looks.
Calls the services and sets the parameters of decision_node. Parameters: see DashboardConfig.
asyncio runs in the main thread, rclpy in one other; they share slots and the history.
"""

from __future__ import annotations

import asyncio
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from functools import partial
from typing import Any

import rclpy
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from rclpy.executors import Executor
from rclpy.node import Node
from rclpy.signals import SignalHandlerOptions
from rclpy.subscription import Subscription
from rover_interfaces.msg import DriveCommand, MissionState, RoverStatus
from sensor_msgs.msg import Image
from std_msgs.msg import String
from visualization_msgs.msg import MarkerArray

from rover_common import topics
from rover_common.errors import RoverError
from rover_common.ros import qos
from rover_common.ros.conversions import command_of, stamp_of, vehicle_state_of
from rover_common.ros.fast_dds import use_profiles
from rover_common.ros.parameters import declare_parameters
from rover_common.ros.runner import WAIT_SECONDS, EventsExecutor
from rover_common.ros.sync import ExactTimeSynchronizer
from rover_dashboard.config import DashboardConfig
from rover_dashboard.conversions import (
    map_of,
    markers_of,
    mission_of,
    picture_of,
    plan_of,
    report_of,
    vehicle_of,
)
from rover_dashboard.feed import OF_RUN, VIEWS, Feed
from rover_dashboard.history import History
from rover_dashboard.node_requests import Requests
from rover_dashboard.protocol import SETTABLE, Answer, Value
from rover_dashboard.server import Server
from rover_dashboard.slots import Slots

LOG_PERIOD = 5.0  # [s] between two lines about messages that cannot be shown
PARAMETERS_PERIOD = 2.0  # [s] between two reads of the decision node's parameters


class DashboardNode(Node):
    """Callbacks only store; the server reads."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("dashboard_node", **kwargs)
        self.config = declare_parameters(self, DashboardConfig)
        self.slots = Slots()
        self.history = History()
        self.requests = Requests(self)
        self._sync = ExactTimeSynchronizer((topics.ODOMETRY, topics.STATUS))
        self._views: list[Subscription] = []
        subscribe = self.create_subscription
        for topic, kind in ((topics.ODOMETRY, Odometry), (topics.STATUS, RoverStatus)):
            subscribe(kind, topic, partial(self._on_part, topic), qos.FRAME)
        subscribe(MissionState, topics.MISSION_STATE, self._on_mission, qos.LATCHED)
        subscribe(String, topics.BRIDGE_STATE, self._on_bridge, qos.LATCHED)

    def set_watched(self, watched: bool) -> None:
        """Somebody looks, or nobody does any more; to be called in the executor's thread."""
        if watched and not self._views:
            subscribe = self.create_subscription
            camera, vision = (partial(self._on_picture, name) for name in ("camera", "vision"))
            self._views = [
                subscribe(Image, topics.IMAGE, camera, qos.VIEW),
                subscribe(Image, topics.VISION_IMAGE, vision, qos.VIEW),
                subscribe(OccupancyGrid, topics.WORLDMAP, self._on_map, qos.LATCHED),
                subscribe(Path, topics.PLAN, self._on_plan, qos.VIEW),
                subscribe(MarkerArray, topics.MISSION_MARKERS, self._on_markers, qos.VIEW),
                subscribe(DriveCommand, topics.COMMAND, self._on_command, qos.FRAME),
            ]
        elif not watched:
            for view in self._views:
                self.destroy_subscription(view)
            self._views = []
            self.slots.empty(VIEWS)
            self.history.stop_viewing()

    def _on_part(self, topic: str, message: Any) -> None:
        parts = self._sync.add(topic, stamp_of(message.header.stamp), message)
        if parts is None:
            return
        status = parts[topics.STATUS]
        vehicle = vehicle_state_of(parts[topics.ODOMETRY], status)
        if self.history.add_frame(vehicle, status.steering_angle):
            self.slots.empty(OF_RUN)
        self.slots.put("vehicle", vehicle_of(vehicle, status))

    def _on_mission(self, message: MissionState) -> None:
        self.history.add_state(report_of(message))
        self.slots.put("mission", mission_of(message))

    def _on_bridge(self, message: String) -> None:
        self.slots.put("simulator", message.data)

    def _on_picture(self, name: str, message: Image) -> None:
        try:
            self.slots.put(name, picture_of(message))
        except RoverError as error:
            self.get_logger().warning(f"{name}: {error}", throttle_duration_sec=LOG_PERIOD)

    def _on_map(self, message: OccupancyGrid) -> None:
        stamped = map_of(message)
        self.history.add_map(stamped.stamp)
        self.slots.put("map", stamped)

    def _on_plan(self, message: Path) -> None:
        self.slots.put("plan", plan_of(message))

    def _on_markers(self, message: MarkerArray) -> None:
        self.slots.put("markers", markers_of(message))

    def _on_command(self, message: DriveCommand) -> None:
        self.history.add_command(command_of(message)[0])


class GraphRobot:
    """The graph, as the server sees it: a node, spun by an executor in its own thread."""

    def __init__(self, node: DashboardNode, executor: Executor) -> None:
        self._node = node
        self._executor = executor
        self._watched = False
        self._reader: asyncio.Task[None] | None = None

    async def request(self, name: str) -> Answer:
        return await self._node.requests.request(name)

    async def set_parameter(self, name: str, value: Value) -> Answer:
        answer = await self._node.requests.set_parameter(name, value)
        await self._read_parameters()
        return answer

    def watch(self, watched: bool) -> None:
        """To be called in the server's thread."""
        if watched == self._watched:
            return
        self._watched = watched
        self._executor.create_task(self._node.set_watched, watched)
        if watched:
            self._reader = asyncio.get_running_loop().create_task(self._read_on())
        elif self._reader is not None:
            self._reader.cancel()

    async def _read_on(self) -> None:
        while True:
            await self._read_parameters()
            await asyncio.sleep(PARAMETERS_PERIOD)

    async def _read_parameters(self) -> None:
        """Others may set them as well, and a decision node that starts again has its own."""
        values = await self._node.requests.parameters(SETTABLE)
        slot = self._node.slots.get("parameters")
        if slot is None or slot.value != values:
            self._node.slots.put("parameters", values)


@contextmanager
def spinning(node: Node) -> Iterator[Executor]:
    """Spin the node in a thread of its own until the block ends."""
    executor = EventsExecutor(context=node.context)
    executor.add_node(node)
    stop = threading.Event()

    def spin() -> None:
        while not stop.is_set():
            executor.spin_once(timeout_sec=WAIT_SECONDS)

    thread = threading.Thread(target=spin, name="rclpy")
    thread.start()
    try:
        yield executor
    finally:
        stop.set()
        thread.join()
        executor.shutdown()


async def serve(node: DashboardNode, executor: Executor, stop: asyncio.Event) -> None:
    """Serve the page until `stop` is set. Raises PortError."""
    config = node.config
    server = Server(Feed(node.slots, node.history), GraphRobot(node, executor), config.host)
    port = await server.start(config.port)
    node.get_logger().info(f"the page is http://{config.host}:{port}/")
    await stop.wait()
    await server.close()


async def _serve_until_signal(node: DashboardNode, executor: Executor) -> None:
    stop = asyncio.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        asyncio.get_running_loop().add_signal_handler(number, stop.set)
    await serve(node, executor, stop)


def main() -> None:
    """Entry point of `ros2 run rover_dashboard dashboard_node`."""
    use_profiles()
    rclpy.init(signal_handler_options=SignalHandlerOptions.NO)
    node = DashboardNode()
    try:
        with suppress(KeyboardInterrupt), spinning(node) as executor:
            asyncio.run(_serve_until_signal(node, executor))
    except RoverError as error:
        node.get_logger().error(str(error))
        sys.exit(1)
    finally:
        node.destroy_node()
        rclpy.try_shutdown()
