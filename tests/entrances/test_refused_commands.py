"""A command that cannot be used is answered with the brake, at once."""

from __future__ import annotations

import math
from functools import partial

import pytest
from telemetry import telemetry
from wire_clients import Decider, answers_to

from rover_bridge.node import BridgeNode
from rover_common import topics
from rover_common.types import Command

LATE = 60.0  # [s] no test waits so long


@pytest.mark.parametrize(
    "command",
    [Command(throttle=math.nan), Command(steering_angle=math.inf), Command(throttle=1e9)],
    ids=["nan", "inf", "huge"],
)
def test_a_command_that_is_no_number_or_out_of_range_is_the_brake(ros, command):
    bridge = ros.add(BridgeNode, port=0, answer_deadline=LATE)
    decider = ros.add(partial(Decider, command))
    assert ros.spin_until(lambda: bridge.count_subscribers(topics.COMMAND) > 0)
    assert ros.spin_until(lambda: decider.count_publishers(topics.STATUS) > 0)
    (answer,) = answers_to(ros, bridge.port, telemetry())
    assert (answer.data["throttle"], answer.data["brake"]) == ("0.0000", "1.0000")
    assert sum(n for key, n in bridge.counts.items() if key.startswith("refused_cmd_drive")) == 1
