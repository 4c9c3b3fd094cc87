"""`rover map`, with a map that is published here."""

from __future__ import annotations

import json

import cv2
import numpy as np
import pytest
from nav_msgs.msg import OccupancyGrid
from rclpy.node import Node
from rover_interfaces.msg import RockTrackArray

from rover_common import topics
from rover_common.ros import qos
from rover_common.ros.conversions import grid_message_of, rocks_message_of
from rover_common.types import FIRST_RUN, GridMap, RockTrack
from rover_tools.cli.main import main

ROCK = RockTrack(1, 91.25, 102.5, (0.1, 0.0, 0.0, 0.1), 5, 7)


@pytest.fixture
def graph(ros, domain_id, monkeypatch):
    """A node that publishes a map of 200 x 200 and a rock, both latched."""
    cells = np.full((200, 200), -1, np.int8)
    cells[80:100, 90:100] = 3
    cells[100, 90:100] = 100
    cells[101, 90:97] = 50
    node = ros.add(lambda **kwargs: Node("perception_node", **kwargs))
    grid = GridMap(1.0, 0.0, 0.0, cells)
    maps = node.create_publisher(OccupancyGrid, topics.WORLDMAP, qos.LATCHED)
    maps.publish(grid_message_of(7, grid))
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain_id))
    return node


@pytest.fixture
def rocks(graph):
    publisher = graph.create_publisher(RockTrackArray, topics.ROCKS, qos.FRAME_LATCHED)
    publisher.publish(rocks_message_of(7, FIRST_RUN, (ROCK,), 7))


@pytest.mark.usefixtures("rocks")
def test_the_counts_are_those_of_the_published_map(capsys):
    assert main(["map", "--json"]) == 0
    assert json.loads(capsys.readouterr().out) == {
        "width": 200, "height": 200, "resolution": 1.0, "unknown": 40000 - 217, "free": 200,
        "edge": 7, "occupied": 10, "rocks": 1, "rocks_found": [{"x": 91.25, "y": 102.5}],
    }  # fmt: skip


@pytest.mark.usefixtures("rocks")
def test_a_picture_is_drawn_where_it_is_asked_for(tmp_path, capsys):
    out = tmp_path / "map.png"
    assert main(["map", "--out", str(out)]) == 0
    assert cv2.imread(str(out)) is not None
    said = capsys.readouterr()
    assert said.err == f"look at {out}\n"
    assert ["occupied", "10"] in [line.split() for line in said.out.splitlines()]


@pytest.mark.usefixtures("graph")
def test_a_map_without_rocks_is_one(capsys):
    assert main(["map", "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["rocks"] == 0


def test_without_a_map_it_gives_up_with_one_line(domain_id, monkeypatch, capsys):
    monkeypatch.setenv("ROS_DOMAIN_ID", str(domain_id))
    assert main(["map", "--wait", "0.2"]) == 1
    error = capsys.readouterr().err
    assert error.startswith(f"rover map: no map came within 0.2 s in domain {domain_id}; ")
    assert error.count("\n") == 1


def test_a_domain_that_is_none_is_one_line(monkeypatch, capsys):
    monkeypatch.setenv("ROS_DOMAIN_ID", "233")
    assert main(["map"]) == 1
    assert capsys.readouterr().err == "rover map: ROS_DOMAIN_ID=233 is no domain: 0 to 232\n"
