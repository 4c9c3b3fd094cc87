"""Definitions of types: as rosbag2 writes them, complete, and of the types installed."""

from __future__ import annotations

import pytest
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

from rover_recorder.errors import RecordingError
from rover_recorder.schemas import SEPARATOR, begins_with_stamp, definition, same_fields

TEXTS = {
    "a/Outer": "# first\nstd_msgs/Header header  # [m]\nInner[<=3] many\nb/Other one\nuint8 X=3\n",
    "a/Inner": "b/Other[4] others\nstring<=5 name\n",
    "b/Other": "float64[] values\n",
    "std_msgs/Header": "builtin_interfaces/Time stamp\nstring frame_id\n",
    "builtin_interfaces/Time": "int32 sec\nuint32 nanosec\n",
}


def test_a_definition_holds_each_contained_type_once():
    parts = definition("a/msg/Outer", TEXTS.__getitem__).split(f"\n{SEPARATOR}\n")
    assert parts[0] == TEXTS["a/Outer"]
    names = ["std_msgs/Header", "a/Inner", "b/Other", "builtin_interfaces/Time"]
    assert parts[1:] == [f"MSG: {name}\n{TEXTS[name]}" for name in names]


@pytest.mark.parametrize(
    "kind",
    [
        "rover_interfaces/msg/RoverStatus",
        "rover_interfaces/msg/RockTrackArray",
        "visualization_msgs/msg/MarkerArray",
        "rcl_interfaces/msg/ParameterEvent",
    ],
)
def test_rosbags_understands_the_definition_of_an_installed_type(kind):
    types = get_types_from_msg(definition(kind), kind)
    store = get_typestore(Stores.EMPTY)
    store.register(types)
    assert store.hash_rihs01(kind).startswith("RIHS01_")


@pytest.mark.parametrize(
    ("kind", "stamped"),
    [
        ("nav_msgs/msg/Odometry", True),
        ("rosgraph_msgs/msg/Clock", True),
        ("rover_interfaces/msg/MissionState", True),  # its constants come first
        ("std_msgs/msg/String", False),
        ("tf2_msgs/msg/TFMessage", False),
        ("std_msgs/msg/Empty", False),
    ],
)
def test_which_types_begin_with_a_time(kind, stamped):
    assert begins_with_stamp(definition(kind)) is stamped


def test_comments_do_not_make_another_definition():
    text = definition("a/msg/Outer", TEXTS.__getitem__)
    assert same_fields(text, text.replace("# first\n", "\n").replace("  # [m]", ""))
    assert not same_fields(text, text.replace("float64", "float32"))


@pytest.mark.parametrize("kind", ["absent_msgs/msg/String", "std_msgs/msg/Absent"])
def test_a_type_that_is_not_installed_is_one_line(kind):
    name = kind.replace("/msg/", "/")
    with pytest.raises(RecordingError, match=f"the type {name} is not installed"):
        definition(kind)
