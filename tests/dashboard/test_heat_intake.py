"""The second robot's mission on the page: what is shown of its messages, and when."""

from __future__ import annotations

import math
from itertools import pairwise

import cv2
import numpy as np
import pytest
from heat_messages import (
    CORRECTION,
    SECOND,
    START,
    markers,
    odometry,
    small_map,
    sources,
    state,
    thermal,
    transforms,
)
from rover_interfaces.msg import MissionState, RoverStatus
from std_msgs.msg import Float32MultiArray

from rover_common import topics
from rover_common.geometry import Pose
from rover_common.ros import conversions
from rover_dashboard.conversions import TF, usable_parts
from rover_dashboard.feed import Feed, Seen
from rover_dashboard.history import History
from rover_dashboard.log import Cursor
from rover_dashboard.node_heat_intake import SPACING
from rover_dashboard.node_intake import Intake
from rover_dashboard.slots import Slots


class Shown:
    """An intake with what it fills."""

    def __init__(self) -> None:
        self.slots = Slots()
        self.history = History()
        self.intake = Intake(self.slots, self.history)

    def take(self, topic, *messages) -> None:
        for message in messages:
            for part in usable_parts(message):
                self.intake.take(topic, part)

    def value(self, name):
        slot = self.slots.get(name)
        return None if slot is None else slot.value

    def rows(self, name) -> list:
        news = self.history.since(name, Cursor())
        return [] if news is None else news.rows


@pytest.fixture
def shown() -> Shown:
    return Shown()


@pytest.fixture
def driving(shown) -> Shown:
    """A mission that has begun."""
    shown.take(topics.HEAT_STATE, state(0.0))
    shown.take(TF, transforms())
    return shown


def test_the_state_says_whose_mission_is_shown(shown):
    assert shown.value("robot") is None
    shown.take(topics.HEAT_STATE, state(3.0))
    assert shown.value("robot") == "heat"
    mission = shown.value("mission")
    assert (mission["state"], mission["elapsed"], mission["payloads"]) == ("EXPLORING", 3.0, 3)
    assert (mission["sources_known"], mission["ramp"]) == (2, "not found")
    for known, done, ramp in ((True, False, "known"), (True, True, "done")):
        shown.take(topics.HEAT_STATE, state(4.0, ramp_known=known, ramp_done=done))
        assert shown.value("mission")["ramp"] == ramp


def test_the_pose_is_in_the_map(driving):
    driving.take(topics.ODOMETRY, odometry(1.0, 0.5))
    vehicle = driving.value("vehicle")
    assert (vehicle["x"], vehicle["y"], vehicle["yaw"]) == (1.0, 0.5, 90.0)
    assert (vehicle["speed"], vehicle["turn"]) == (0.2, 5.7)
    assert driving.rows("track") == [(1.0, 0.5)]


def test_before_state_and_transform_nothing_is_placed(shown):
    shown.take(TF, transforms())
    shown.take(topics.ODOMETRY, odometry(1.0, 0.5))
    assert shown.value("vehicle") is None
    late = Shown()
    late.take(topics.HEAT_STATE, state(0.0))
    late.take(topics.ODOMETRY, odometry(1.0, 0.5))
    assert late.value("vehicle") is None


def test_a_jump_of_the_correction_moves_the_robot(driving):
    driving.take(topics.ODOMETRY, odometry(1.0, 0.5))
    moved = Pose(CORRECTION.x + 0.2, CORRECTION.y, CORRECTION.yaw)
    driving.take(TF, transforms(1.1, moved))
    driving.take(topics.ODOMETRY, odometry(1.1, 0.5))
    assert driving.value("vehicle")["x"] == 1.2


def test_the_track_has_points_of_a_small_robot(driving):
    for tick in range(100):
        driving.take(topics.ODOMETRY, odometry(tick / 30, 0.007 * tick))
    ys = [y for _, y in driving.rows("track")]
    assert ys[-1] > 0.65
    assert all(later - before >= SPACING for before, later in pairwise(ys))


def test_plots_have_turn_rate_and_warmest_pixels(driving):
    driving.take(topics.ODOMETRY, odometry(0.0, 0.0))
    driving.take(topics.TEMPERATURE_1, thermal(30.0))
    driving.take(topics.MAP, small_map(0.5))
    driving.take(topics.ODOMETRY, odometry(1.0, 0.5))
    row = driving.rows("plots")[1]
    assert row[:5] == (1.0, 0.2, 5.7, 7.0, None)
    assert row[-1] == 0.5  # age of the map
    driving.intake.stop_viewing()
    driving.take(topics.ODOMETRY, odometry(2.0, 0.6))
    assert driving.rows("plots")[2][3] is None


def test_a_thermal_frame_becomes_a_picture(driving):
    feed = Feed(driving.slots, driving.history)
    driving.take(topics.TEMPERATURE_2, thermal())
    (message,) = [m for m in feed.news(Seen()) if isinstance(m, bytes)]
    header, content = message.split(b"\n", 1)
    assert b'"slot":"thermal_2"' in header
    image = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_COLOR)
    assert image.shape == (8, 8, 3)
    assert image[2, 5].sum() > image[0, 0].sum() + 200


@pytest.mark.parametrize("count", [0, 63, 65])
def test_an_array_of_another_size_is_no_picture(driving, count):
    driving.take(topics.TEMPERATURE_1, Float32MultiArray(data=[20.0] * count))
    assert driving.value("thermal_1") is None


def test_a_frame_with_a_pixel_that_is_no_number_is_shown_and_not_plotted(driving):
    driving.take(topics.TEMPERATURE_1, thermal(math.nan))
    assert driving.value("thermal_1").image.shape == (8, 8, 3)
    driving.take(topics.ODOMETRY, odometry(1.0, 0.5))
    assert driving.rows("plots")[0][3] is None


def test_sources_and_what_is_kept_away_from(driving):
    driving.take(topics.HEAT_SOURCES, sources())
    assert driving.value("sources") == [
        {"id": 1, "x": 1.0, "y": 2.0, "observations": 25, "peak": 6.0, "delivered": True}
    ]
    driving.take(topics.HEAT_MARKERS, markers())
    shown = driving.value("markers")
    strip, disc = shown["outlines"]
    assert sorted(strip) == [(1.75, -0.625), (1.75, 0.625), (2.25, -0.625), (2.25, 0.625)]
    assert all(math.hypot(*point) == pytest.approx(0.2, abs=1e-3) for point in disc)
    assert (shown["goal"], shown["examined"]) == ([(1.0, 1.0)], [(0.0, 0.0), (0.05, 0.0)])
    assert "frontiers" not in shown


def test_the_timeline_begins_with_the_run_and_again_with_another(driving):
    driving.take(topics.ODOMETRY, odometry(0.1, 0.0))
    driving.take(topics.HEAT_STATE, state(2.0, "LAUNCHING"), state(2.5, "LAUNCHING"))
    assert [row[:2] for row in driving.rows("timeline")] == [(0.0, "EXPLORING"), (2.0, "LAUNCHING")]
    driving.take(topics.MAP, small_map())
    again = state(0.0, "INITIALIZING", run=2)
    again.header.stamp = conversions.time_of(START + 9 * SECOND)
    driving.take(topics.HEAT_STATE, again)
    driving.take(topics.ODOMETRY, odometry(9.1, 0.0))
    assert [row[1] for row in driving.rows("timeline")] == ["INITIALIZING"]
    assert driving.value("map") is None


def test_a_mission_node_that_starts_again_is_another_run(driving):
    driving.take(topics.ODOMETRY, odometry(5.0, 0.0), odometry(6.0, 0.5))
    again = state(0.0)
    again.header.stamp = conversions.time_of(START + 20 * SECOND)
    driving.take(topics.HEAT_STATE, again)
    driving.take(topics.ODOMETRY, odometry(20.5, 0.5))
    assert len(driving.rows("track")) == 1


def test_the_rovers_mission_takes_the_page_back(driving):
    driving.take(topics.ODOMETRY, odometry(1.0, 0.5))
    driving.take(topics.HEAT_SOURCES, sources())
    driving.take(topics.MISSION_STATE, MissionState(state_name="STOP", run=1))
    assert driving.value("robot") == "rover"
    assert driving.value("sources") is None
    assert driving.value("mission")["state"] == "STOP"
    assert driving.rows("track") == []
    stamp = 3 * SECOND
    driving.take(topics.ODOMETRY, conversions.odometry_of(stamp, Pose(50.0, 60.0, 0.0), 1.0))
    driving.take(
        topics.STATUS, RoverStatus(header=conversions.header_of(stamp, "base_link"), run=1)
    )
    assert driving.rows("track") == [(50.0, 60.0)]
