"""The insets of the bridge's answers, over a real socket."""

from __future__ import annotations

import base64
import threading
from collections.abc import Callable, Iterator
from typing import Any

import cv2
import numpy as np
import pytest
from nav_msgs.msg import OccupancyGrid
from rclpy.node import Node
from rover_interfaces.msg import RockTrackArray
from sensor_msgs.msg import Image
from telemetry import telemetry
from wire_clients import WAIT, Decider, Unity, run_clients

from rover_bridge import node_insets
from rover_bridge.node import BridgeNode
from rover_common import frames, topics
from rover_common.ros import conversions, qos
from rover_common.ros.message_checks import MessageError
from rover_common.types import FIRST_RUN, GridMap, RockTrack

INSETS = "bridge_node_insets"
GREY = np.full((160, 320, 3), 128, np.uint8)
FREE, FREE_COLOR, ROCK_COLOR = (60.5, 150.5), (60, 105, 225), (255, 255, 0)
PATIENCE = 200  # telemetries within which a pair must have come


class Source(Node):
    """Publishes what the insets are made of, as perception does."""

    def __init__(self, **kwargs: Any) -> None:
        super().__init__("source", **kwargs)
        cells = np.full((200, 200), -1, np.int8)
        cells[150, 60] = 0
        stamp = 2 * 10**18  # of the present run, whenever it began
        rock = RockTrack(1, 100.0, 100.0, (0.0, 0.0, 0.0, 0.0), 1, 0)
        self._messages = [
            (OccupancyGrid, topics.WORLDMAP, qos.LATCHED,
             conversions.grid_message_of(stamp, GridMap(1.0, 0.0, 0.0, cells))),
            (RockTrackArray, topics.ROCKS, qos.FRAME_LATCHED,
             conversions.rocks_message_of(stamp, FIRST_RUN, (rock,), stamp)),
            (Image, topics.BIRDSEYE_IMAGE, qos.VIEW,
             conversions.image_message_of(stamp, frames.BASE, GREY)),
        ]  # fmt: skip
        publishers = [self.create_publisher(*args) for *args, _ in self._messages]
        pairs = list(zip(publishers, (message for *_, message in self._messages), strict=True))
        self.create_timer(0.05, lambda: [p.publish(message) for p, message in pairs])


@pytest.fixture
def bridge(ros) -> Callable[..., BridgeNode]:
    """Makes a bridge with these parameters, among nodes that answer it and that it draws."""

    def make(**parameters: Any) -> BridgeNode:
        values = {"port": 0, "answer_deadline": 5.0, "inset_period": 0.05} | parameters
        node = ros.add(BridgeNode, **values)
        decider = ros.add(Decider)
        ros.add(Source)
        assert ros.spin_until(lambda: node.count_subscribers(topics.COMMAND) > 0)
        assert ros.spin_until(lambda: decider.count_publishers(topics.STATUS) > 0)
        return node

    return make


def ask_until(
    unity: Unity, found: Callable[[dict[str, Any]], Any], most: int = PATIENCE, **changes: Any
) -> dict | None:
    """The first of these many answers that is what is sought, None when none is."""
    for _ in range(most):
        answer = dict(unity.ask(telemetry() | changes).data)
        if found(answer):
            return answer
    return None


def both(answer: dict[str, Any]) -> bool:
    return bool(answer["inset_image1"] and answer["inset_image2"])


def any_inset(answer: dict[str, Any]) -> bool:
    return bool(answer["inset_image1"] or answer["inset_image2"])


def picture_of(text: str) -> np.ndarray:
    data = np.frombuffer(base64.b64decode(text, validate=True), np.uint8)
    return cv2.cvtColor(cv2.imdecode(data, cv2.IMREAD_COLOR), cv2.COLOR_BGR2RGB).astype(int)


def with_client(ros: Any, port: int, body: Callable[[Unity], Any]) -> Any:
    def run() -> Any:
        with Unity(port) as unity:
            return body(unity)

    return run_clients(ros, run)[0]


def test_the_original_gets_map_and_birdseye_view(ros, bridge):
    def mapped(answer: dict[str, Any]) -> bool:
        if not both(answer):
            return False
        shown = picture_of(answer["inset_image1"])
        cells = shown[399 - int(FREE[1] * 2), int(FREE[0] * 2)], shown[199, 200]
        return all(
            np.abs(cell - color).max() < 40
            for cell, color in zip(cells, (FREE_COLOR, ROCK_COLOR), strict=True)
        )

    node = bridge()
    answer = with_client(ros, node.port, lambda unity: ask_until(unity, mapped))
    assert answer is not None
    assert np.abs(picture_of(answer["inset_image2"]) - GREY).max() < 4


@pytest.mark.parametrize(
    ("mode", "changes", "shown"),
    [
        ("auto", {"sim_time": "1.0"}, False),
        ("auto", {"sim_time": "1.0", "shows_insets": "1"}, True),
        ("auto", {"shows_insets": "0"}, False),
        ("never", {}, False),
        ("always", {"sim_time": "1.0"}, True),
    ],
)
def test_insets_are_for_clients_that_show_them(ros, bridge, mode, changes, shown):
    node = bridge(insets=mode)
    most = PATIENCE if shown else 5
    answer = with_client(ros, node.port, lambda unity: ask_until(unity, any_inset, most, **changes))
    assert (answer is not None) is shown
    assert (node._insets._thread is not None) is shown


def test_a_pair_is_sent_once(ros, bridge):
    node = bridge(inset_period=60.0)

    def body(unity: Unity) -> list[dict[str, Any]]:
        unity.ask(telemetry())
        node._insets._finished.append(node_insets.Insets("bWFw", "YmlyZA=="))
        return [dict(unity.ask(telemetry()).data) for _ in range(2)]

    first, second = with_client(ros, node.port, body)
    assert (first["inset_image1"], first["inset_image2"]) == ("bWFw", "YmlyZA==")
    assert not any_inset(second)


def test_a_client_that_is_not_active_gets_none(ros, bridge):
    node = bridge(inset_period=60.0)

    def body(unity: Unity) -> tuple[dict[str, Any], dict[str, Any]]:
        unity.ask(telemetry())
        node._insets._finished.append(node_insets.Insets("bWFw", "YmlyZA=="))
        with Unity(node.port) as other:
            refused = dict(other.ask(telemetry()).data)
        return refused, dict(unity.ask(telemetry()).data)

    refused, answer = with_client(ros, node.port, body)
    assert not any_inset(refused)
    assert both(answer)


@pytest.fixture
def blocked(monkeypatch) -> Iterator[threading.Event]:
    """A drawing that has begun, and does not end before the test does."""
    begun, go_on = threading.Event(), threading.Event()

    def draw(*_: Any) -> np.ndarray:
        begun.set()
        go_on.wait(WAIT)
        return GREY

    monkeypatch.setattr(node_insets, "map_inset", draw)
    yield begun
    go_on.set()


def test_a_drawing_that_does_not_end_delays_no_answer(ros, bridge, blocked):
    node = bridge()

    def body(unity: Unity) -> bool:
        begun = ask_until(unity, lambda _: blocked.is_set()) is not None
        return begun and all(not any_inset(dict(unity.ask(telemetry()).data)) for _ in range(20))

    assert with_client(ros, node.port, body)


def test_the_node_is_there_while_a_client_shows_insets(ros, bridge):
    node = bridge()

    def there() -> bool:
        return INSETS in node.get_node_names()

    assert not there()
    with_client(ros, node.port, lambda unity: ask_until(unity, lambda _: there()))
    assert ros.spin_until(lambda: not there())  # the client has left


def test_a_picture_that_cannot_be_used_ends_no_drawing(ros, bridge, monkeypatch):
    made = conversions.image_of
    bad = iter([True, True])

    def image_of(message: Image) -> np.ndarray:
        if next(bad, False):
            raise MessageError("image encoding 'mono8', expected rgb8")
        return made(message)

    monkeypatch.setattr(node_insets, "image_of", image_of)
    node = bridge()
    assert with_client(ros, node.port, lambda unity: ask_until(unity, both)) is not None
