"""When heat_node may decide on a tick, and when it may answer it, in lockstep.

    sensor_tick -> batch and the navigator's step -> decide -> the navigator's answers -> answer

Deciding waits for all that belongs to the tick, answering until the navigator has taken what was
asked of it. So computing time does not change a mission. A navigator that says nothing for PATIENCE
counts as absent until it speaks again; each tick waits a little for it, so that the mission's clock
creeps while one that was killed is started again, and runs on for one that never comes back.
"""

from __future__ import annotations

import time
from collections.abc import Callable

from rclpy.node import Node
from rover_interfaces.msg import NavigationTick

from rover_common import topics
from rover_common.ros import qos
from rover_common.ros.conversions import stamp_of
from rover_common.sensor_types import SensorBatch
from rover_heat.node_sensors import HeatSensors
from rover_navigation.node_client import ActionNavigator

# [s] of wall time: one that is started again is there by then; the simulator's is longer. And of
# each tick of one that is absent: a minute of wall time is some eight seconds of the mission.
PATIENCE, PATIENCE_ABSENT = 12.0, 0.25


class HeatLockstep:
    """`work` whenever something was heard."""

    def __init__(
        self,
        node: Node,
        sensors: HeatSensors,
        navigator: ActionNavigator,
        plan_ready: Callable[[int], bool],
        decide: Callable[[SensorBatch], None],
        answer: Callable[[int, bool], None],
    ) -> None:
        """answer: gets the stamp [ns] of the tick, and whether the navigator drives at it."""
        self._sensors = sensors
        self._navigator = navigator
        self._plan_ready = plan_ready
        self._decide = decide
        self._answer = answer
        self._batch: SensorBatch | None = None
        self._decided = False
        self._since = 0.0  # [s] of wall time of this tick's step
        self._tick = NavigationTick()
        self._speakers = 0
        self._absent = False
        self._alone = False  # this tick has waited long enough for the navigator
        self._working = False
        self.hazards = 0  # [ns] stamp of the newest hazard map that was sent
        self.missing = 0  # ticks that the navigator said nothing to
        self.subscription = node.create_subscription(
            NavigationTick, topics.NAVIGATION_TICK, self._on_tick, qos.SENSOR
        )

    def work(self) -> None:
        """Go as far as what is there allows."""
        if self._working:  # what is decided may make itself heard
            return
        self._working = True
        while self._step():
            pass
        self._working = False

    def check_patience(self) -> None:
        """To be called from time to time."""
        speakers = self.subscription.get_publisher_count()
        # One that was started again has not heard the tick at hand.
        self._absent |= speakers > self._speakers and self._navigator_stamp > 0
        self._speakers = speakers
        patience = PATIENCE_ABSENT if self._absent else PATIENCE
        if self._batch is not None and time.monotonic() - self._since >= patience:
            self._absent = self._alone = True
            self.missing += 1
            self.work()

    def _step(self) -> bool:
        """Whether something could be done."""
        if self._batch is None:
            self._batch = self._sensors.collector.take_complete()
            self._since = time.monotonic()
            return self._batch is not None
        if not self._decided and self._may_decide(self._batch):
            self._decided, self._since = True, time.monotonic()
            self._decide(self._batch)
            return True
        if self._decided and self._may_answer():
            stamp = self._batch.stamp
            self._batch, self._decided, self._alone = None, False, False
            self._answer(stamp, self._tick.velocity and self._navigator_stamp == stamp)
            return True
        return False

    @property
    def _navigator_stamp(self) -> int:
        return stamp_of(self._tick.header.stamp)

    def _may_decide(self, batch: SensorBatch) -> bool:
        poses, stamp = self._sensors.poses, batch.stamp
        if batch.odometry and poses.newest_odometry < batch.odometry[-1].stamp:
            return False
        if not self._plan_ready(stamp):
            return False
        if self._alone:
            return True
        return (
            self._navigator_stamp >= stamp
            and (not self._tick.transform or poses.newest_correction >= stamp)
            and (not self._tick.map or self._sensors.grid_stamp >= stamp)
            and self._navigator.told_about(stamp)
        )

    def _may_answer(self) -> bool:
        if self._alone:
            return True
        return self._navigator.settled and stamp_of(self._tick.hazards) >= self.hazards

    def _on_tick(self, message: NavigationTick) -> None:
        self._tick, self._absent, self._alone = message, False, False
        self.work()
