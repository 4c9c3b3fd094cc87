"""The dashboard node: serves a live page of the mission of either robot.

Subscribes odom and rover_status (joined by stamp), mission_state, bridge_state, heat_state, /tf and
/diagnostics all the time; camera/image_raw/compressed, vision_image, worldmap, plan,
mission_markers and cmd_drive, map, heat_markers, heat_sources and temperature_sensor_1 and _2 while
somebody looks. Calls the services of decision_node and of heat_node, and sets the parameters of
decision_node. Parameters: see DashboardConfig.
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
from diagnostic_msgs.msg import DiagnosticArray
from nav_msgs.msg import OccupancyGrid, Odometry, Path
from rclpy.executors import Executor
from rclpy.node import Node
from rclpy.qos import QoSProfile
from rclpy.signals import SignalHandlerOptions
from rclpy.subscription import Subscription
from rover_interfaces.msg import (
    DriveCommand,
    HeatSourceArray,
    HeatState,
    MissionState,
    RoverStatus,
)
from sensor_msgs.msg import CompressedImage, Image
from std_msgs.msg import Float32MultiArray, String
from tf2_msgs.msg import TFMessage
from visualization_msgs.msg import MarkerArray

from rover_common import topics
from rover_common.errors import RoverError
from rover_common.ros import qos
from rover_common.ros.parameters import declare_parameters
from rover_common.ros.priority import give_way
from rover_common.ros.runner import (
    WAIT_SECONDS,
    EventsExecutor,
    spin_for,
    start_errors,
    start_ros,
)
from rover_dashboard.config import DashboardConfig
from rover_dashboard.conversions import DIAGNOSTICS, TF
from rover_dashboard.feed import Feed
from rover_dashboard.history import History
from rover_dashboard.node_intake import HEAT, Intake
from rover_dashboard.node_requests import DECISION, HEAT_NODE, Requests
from rover_dashboard.protocol import (
    SETTABLE,
    Answer,
    MissionRequest,
    ParameterChange,
    PlaybackChange,
    Wish,
)
from rover_dashboard.server import Server
from rover_dashboard.slots import Slots

LOG_PERIOD = 5.0  # [s] between two lines about messages that cannot be shown
PARAMETERS_PERIOD = 2.0  # [s] between two reads of the decision node's parameters

Endpoints = tuple[tuple[str, type, QoSProfile], ...]  # topic, type, QoS
ALWAYS: Endpoints = (
    (topics.ODOMETRY, Odometry, qos.FRAME),
    (topics.STATUS, RoverStatus, qos.FRAME),
    (topics.MISSION_STATE, MissionState, qos.LATCHED),
    (topics.BRIDGE_STATE, String, qos.LATCHED),
    (topics.HEAT_STATE, HeatState, qos.LATCHED),
    (TF, TFMessage, qos.TF),
    (DIAGNOSTICS, DiagnosticArray, qos.DIAGNOSTICS),
)
WATCHED: Endpoints = (  # while somebody looks
    (topics.COMPRESSED_IMAGE, CompressedImage, qos.VIEW),
    (topics.VISION_IMAGE, Image, qos.VIEW),
    (topics.WORLDMAP, OccupancyGrid, qos.LATCHED),
    (topics.PLAN, Path, qos.VIEW),
    (topics.MISSION_MARKERS, MarkerArray, qos.VIEW),
    (topics.COMMAND, DriveCommand, qos.FRAME),
    (topics.MAP, OccupancyGrid, qos.LATCHED),
    (topics.HEAT_MARKERS, MarkerArray, qos.VIEW),
    (topics.HEAT_SOURCES, HeatSourceArray, qos.LATCHED),
    (topics.TEMPERATURE_1, Float32MultiArray, qos.SENSOR),
    (topics.TEMPERATURE_2, Float32MultiArray, qos.SENSOR),
)


class DashboardNode(Node):
    """Callbacks only store; the server reads."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("dashboard_node", **kwargs)
        self.config = declare_parameters(self, DashboardConfig)
        self.slots = Slots()
        self.history = History()
        self.requests = Requests(self)
        self._intake = Intake(self.slots, self.history)
        self._views: list[Subscription] = []
        self._subscribe(ALWAYS)

    def _subscribe(self, endpoints: Endpoints) -> list[Subscription]:
        return [
            self.create_subscription(kind, topic, partial(self._on_message, topic), profile)
            for topic, kind, profile in endpoints
        ]

    @property
    def mission_node(self) -> str:
        """The node of the mission that is shown."""
        return HEAT_NODE if self._intake.robot == HEAT else DECISION

    def set_watched(self, watched: bool) -> None:
        """Somebody looks, or nobody does any more; to be called in the executor's thread."""
        if watched and not self._views:
            self._views = self._subscribe(WATCHED)
        elif not watched:
            for view in self._views:
                self.destroy_subscription(view)
            self._views = []
            self._intake.stop_viewing()

    def _on_message(self, topic: str, message: Any) -> None:
        try:
            self._intake.take(topic, message)
        except RoverError as error:
            self.get_logger().warning(f"{topic}: {error}", throttle_duration_sec=LOG_PERIOD)


class GraphRobot:
    """The graph, as the server sees it: a node, spun by an executor in its own thread."""

    def __init__(self, node: DashboardNode, executor: Executor) -> None:
        self._node = node
        self._executor = executor
        self._watched = False
        self._reader: asyncio.Task[None] | None = None

    async def carry_out(self, wish: Wish) -> Answer:
        match wish:
            case MissionRequest(name):
                return await self._node.requests.request(self._node.mission_node, name)
            case ParameterChange() if self._node.mission_node != DECISION:
                return Answer(False, "no parameter of this mission may be set while it runs")
            case ParameterChange(name, value):
                answer = await self._node.requests.set_parameter(name, value)
                await self._read_parameters()
                return answer
            case PlaybackChange():
                return Answer(False, "this is a live mission, not a recording")

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
        if self._node.mission_node != DECISION:
            return
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
            spin_for(executor, WAIT_SECONDS)

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
    give_way()
    with start_errors():
        start_ros(signal_handler_options=SignalHandlerOptions.NO)
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
