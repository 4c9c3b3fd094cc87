"""What each viewer is sent: news only, encoded once for all of them."""

from __future__ import annotations

import json

import cv2
import numpy as np
import pytest

from rover_common.types import GridMap
from rover_dashboard import feed as feed_module
from rover_dashboard.encoders import UNKNOWN, Jpeg, Picture, StampedMap, map_of, picture_of
from rover_dashboard.feed import Feed, Seen
from rover_dashboard.history import LOGS, History
from rover_dashboard.slots import Slots

IMAGE = np.zeros((160, 320, 3), np.uint8)
IMAGE[:, :160] = (200, 30, 60)  # RGB


def decode(content: bytes) -> np.ndarray:
    """RGB, or grey."""
    image = cv2.imdecode(np.frombuffer(content, np.uint8), cv2.IMREAD_UNCHANGED)
    return image if image.ndim == 2 else cv2.cvtColor(image, cv2.COLOR_BGR2RGB)


def header_of(message: bytes) -> dict:
    return json.loads(message.split(b"\n", 1)[0])


def of_slots(messages) -> dict:
    """Messages by slot, without those of the history."""
    found = {}
    for message in messages:
        header = json.loads(message) if isinstance(message, str) else header_of(message)
        if header["slot"] not in LOGS:
            found[header["slot"]] = message
    return found


@pytest.fixture
def slots() -> Slots:
    return Slots()


@pytest.fixture
def feed(slots) -> Feed:
    return Feed(slots, History())


def test_a_viewer_gets_only_the_newest_value_and_only_once(slots, feed):
    seen = Seen()
    slots.put("mission", {"state": "STOP"})
    slots.put("mission", {"state": "FORWARD"})
    messages = of_slots(feed.news(seen))
    assert json.loads(messages["mission"])["data"] == {"state": "FORWARD"}
    assert of_slots(feed.news(seen)) == {}


def test_a_picture_is_encoded_once_for_all_viewers(slots, feed, monkeypatch):
    encoded = []

    def count(picture):
        encoded.append(picture)
        return picture_of(picture)

    monkeypatch.setitem(feed_module.ENCODERS, "camera", count)
    slots.put("camera", Picture(3_000_000_000, IMAGE))
    first, second = (of_slots(feed.news(Seen()))["camera"] for _ in range(2))
    assert len(encoded) == 1
    assert first.split(b"\n", 1)[1] == second.split(b"\n", 1)[1]
    assert header_of(first)["stamp"] == 3.0


def test_a_message_has_the_age_of_its_value():
    now = [10.0]
    slots = Slots(lambda: now[0])
    feed = Feed(slots, History())
    slots.put("camera", Picture(0, IMAGE))
    slots.put("mission", {})
    now[0] = 12.5
    messages = of_slots(feed.news(Seen()))
    assert header_of(messages["camera"])["age"] == 2.5
    assert json.loads(messages["mission"])["age"] == 2.5


def test_what_is_no_longer_true_is_taken_back(slots, feed):
    seen = Seen()
    slots.put("camera", Picture(0, IMAGE))
    slots.put("plan", [(1.0, 2.0)])
    list(feed.news(seen))
    slots.empty(["camera", "plan", "markers"])
    messages = of_slots(feed.news(seen))
    assert {name: json.loads(text)["data"] for name, text in messages.items()} == {
        "camera": None, "plan": None
    }  # fmt: skip


def test_an_image_that_is_compressed_already_goes_on_as_it_is():
    encoded = picture_of(Jpeg(2_000_000_000, b"a file"))
    assert encoded.content == b"a file"
    assert encoded.facts == {"type": "image/jpeg", "stamp": 2.0}


def test_a_vision_image_stays_exact():
    assert (decode(picture_of(Picture(0, IMAGE)).content) == IMAGE).all()


def test_a_map_is_cropped_to_what_is_known_with_north_at_its_top():
    cells = np.full((200, 200), -1, np.int8)
    cells[100, 50:60] = 0  # y = 100..101 m
    cells[110, 50] = 100  # north of it
    encoded = map_of(StampedMap(2_000_000_000, GridMap(1.0, 0.0, 0.0, cells)))
    picture, facts = decode(encoded.content), encoded.facts
    assert picture.shape == (11 + 6, 10 + 6)
    assert (facts["x"], facts["y"]) == (47.0, 97.0)
    assert (facts["width"], facts["height"]) == (16.0, 17.0)
    assert (facts["ground"], facts["resolution"]) == (10, 1.0)
    assert picture[3, 3] == 100  # the obstacle, in the upper part
    assert (picture[13, 3:13] == 0).all()
    assert picture[0, 0] == UNKNOWN


def test_the_margin_of_a_map_is_in_cells():
    cells = np.full((200, 200), -1, np.int8)
    cells[100, 50] = 0
    facts = map_of(StampedMap(0, GridMap(0.05, -1.0, -2.0, cells))).facts
    assert (facts["width"], facts["height"]) == (pytest.approx(0.35), pytest.approx(0.35))
    assert (facts["x"], facts["y"]) == (pytest.approx(1.35), pytest.approx(2.85))


def test_a_map_without_known_ground_is_nothing():
    assert map_of(StampedMap(0, GridMap(1.0, 0.0, 0.0, np.full((9, 9), -1, np.int8)))) is None
