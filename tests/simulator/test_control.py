"""simulator_node does what people ask of it, while a server answers it or not."""

from __future__ import annotations

import math

import pytest
from answering_server import Answering
from rclpy.parameter import Parameter
from simulation_interfaces.msg import Result
from simulation_services import PAUSED, PLAYING, STOPPED, Person

from rover_bridge.transport import WireLimits
from rover_simulator.node import SimulatorNode
from rover_simulator.run import frame_steps_of
from rover_simulator.simulation import START_TIME
from rover_simulator.vehicle.vehicle import STEP

OK = Result.RESULT_OK
FRAME = frame_steps_of(25.0) * STEP


@pytest.fixture
def server():
    answering = Answering(WireLimits())
    yield answering.server
    answering.server.close()


@pytest.fixture
def person(ros) -> Person:
    return Person(ros)


def make(ros, server, **parameters):
    return ros.add(SimulatorNode, port=server.port, size=0.3, **parameters)


@pytest.mark.parametrize("rate", [0, 20.0])
def test_it_pauses_steps_and_goes_on(ros, server, person, rate):
    node = make(ros, server, rate=rate)
    assert ros.spin_until(lambda: node.simulation.time > START_TIME + FRAME)
    assert person.state() == PLAYING
    assert person.step(1).result == Result.RESULT_OPERATION_FAILED
    assert person.set_state(PAUSED).result == OK
    assert person.step(1).result == OK  # which ends the frame that was being made
    stopped = node.simulation.time
    assert not ros.spin_until(lambda: node.simulation.time > stopped, timeout=0.3)
    assert person.step(5).result == OK
    assert node.simulation.time == pytest.approx(stopped + 5 * FRAME)
    assert person.set_state(PLAYING).result == OK
    assert ros.spin_until(lambda: node.simulation.time > stopped + 10 * FRAME)


def test_a_reset_begins_anew_and_a_stop_waits_there(ros, server, person):
    node = make(ros, server, rate=20.0)
    start = node.simulation.pose
    assert ros.spin_until(lambda: node.simulation.time > START_TIME + 1.0)
    assert person.set_state(STOPPED).result == OK
    assert node.simulation.time == START_TIME
    assert node.simulation.pose == start
    assert person.state() == PAUSED


def test_it_is_placed_on_navigable_ground_alone(ros, server, person):
    node = make(ros, server, start_paused=True, rate=20.0)
    start = node.simulation.pose
    assert person.place(start.x, start.y, 1.0, entity="rover").result == OK
    assert math.remainder(node.simulation.pose.yaw - 1.0, math.tau) == pytest.approx(0.0)
    refused = person.place(1.0, 1.0, 0.0)
    assert refused.result == Result.RESULT_OPERATION_FAILED
    assert "not navigable" in refused.error_message
    assert person.place(start.x, start.y, 0.0, entity="tree").result == Result.RESULT_NOT_FOUND


def test_its_speed_may_be_set_and_the_run_goes_on(ros, server, person):
    node = make(ros, server, rate=0.01)
    before = node.simulation.time
    (result,) = node.set_parameters([Parameter("rate", value=0)])
    assert result.successful
    assert ros.spin_until(lambda: node.simulation.time > before + 2.0)


def test_without_a_server_it_can_be_reset_but_not_stepped(ros, person, monkeypatch):
    monkeypatch.setattr("rover_simulator.node.STEP_PATIENCE", 0.3)
    ros.add(SimulatorNode, port=1, size=0.3, start_paused=True, rate=0.0)
    assert person.reset().result == OK
    assert person.step(1).result == Result.RESULT_OPERATION_FAILED


def test_a_world_that_cannot_be_read_is_an_error(ros, server, tmp_path):
    with pytest.raises(Exception, match=r"map\.png"):
        make(ros, server, world=str(tmp_path))
