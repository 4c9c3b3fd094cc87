"""Messages that cannot be used are recognised by themselves."""

from __future__ import annotations

import numpy as np
import pytest

from rover_common.geometry import Pose
from rover_common.ros import conversions
from rover_common.ros.message_checks import check_message
from rover_common.types import FIRST_RUN, FreeScan, GridMap, PolarArray, RockTrack
from rover_tools.chaos.graph_shapes import GraphShape
from rover_tools.chaos.node_graph_faults import JUNK

STAMP = 5_000_000_000
NUMBERS = np.array([1.0, 2.0], np.float32)
SCAN = FreeScan(-0.5, 0.1, 0.0, 5.0, np.array([1.0, np.inf], np.float32))
ROCK = RockTrack(1, 2.0, 3.0, (0.1, 0.0, 0.0, 0.1), 5, STAMP)
GOOD = (
    conversions.odometry_of(STAMP, Pose(1.0, 2.0, 0.5, 0.02, -0.1), 1.0),
    conversions.image_message_of(STAMP, "camera", np.zeros((160, 320, 3), np.uint8)),
    conversions.polar_message_of(STAMP, FIRST_RUN, PolarArray(NUMBERS, NUMBERS)),
    conversions.polar_message_of(STAMP, FIRST_RUN, PolarArray(NUMBERS[:0], NUMBERS[:0])),
    conversions.scan_message_of(STAMP, SCAN),
    conversions.rocks_message_of(STAMP, FIRST_RUN, (ROCK,), STAMP),
    conversions.rocks_message_of(STAMP, FIRST_RUN, (), STAMP),
    conversions.grid_message_of(STAMP, GridMap(1.0, 0.0, 0.0, np.zeros((4, 5), np.int8))),
)
# A clock has no content of its own, and the bridge brakes by a command of NaN.
UNCHECKED = {
    GraphShape.CLOCK_AT_ZERO, GraphShape.CLOCK_FAR_AHEAD, GraphShape.COMMAND_OF_NAN,
}  # fmt: skip


@pytest.mark.parametrize("message", GOOD, ids=lambda message: type(message).__name__)
def test_what_our_nodes_send_is_used(message):
    check_message(message)


@pytest.mark.parametrize("shape", sorted(set(GraphShape) - UNCHECKED))
def test_what_no_node_sends_is_refused(shape):
    with pytest.raises(conversions.MessageError):
        check_message(JUNK[shape].make(STAMP))
