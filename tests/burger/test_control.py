"""burger_node does what people ask of it: pause, step, speed, reset, teleport, life cycle."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest
from lifecycle_msgs.msg import Transition
from lifecycle_msgs.srv import ChangeState
from nav_msgs.msg import Odometry
from rclpy.parameter import Parameter
from rosgraph_msgs.msg import Clock
from simulation_interfaces.msg import Result, SimulatorFeatures
from simulation_interfaces.srv import ResetSimulation, SetEntityState
from simulation_services import PAUSED, PLAYING, STOPPED, Person

from burger_simulator.node import BurgerNode
from rover_common import topics
from rover_common.ros import qos
from rover_common.ros.conversions import stamp_of

OK = Result.RESULT_OK
DEMO = {"family": "demo", "rate": 20.0}


@pytest.fixture
def person(ros) -> Person:
    return Person(ros)


def test_it_pauses_goes_on_and_stops_at_the_beginning(ros, person):
    node = ros.add(BurgerNode, **DEMO)
    assert person.state() == PLAYING
    assert person.set_state(PAUSED).result == OK
    stopped = node.simulation.stamp
    assert not ros.spin_until(lambda: node.simulation.stamp > stopped, timeout=0.3)
    assert person.state() == PAUSED
    assert person.set_state(PLAYING).result == OK
    assert ros.spin_until(lambda: node.simulation.stamp > stopped)
    assert person.set_state(STOPPED).result == OK
    assert node.simulation.truth.distance == 0.0
    assert node.paused


def test_it_steps_while_it_is_paused(ros, person):
    node = ros.add(BurgerNode, start_paused=True, **DEMO)
    assert person.step(3).result == OK
    assert node.simulation.stamp == 1_150_000_000
    assert person.set_state(PLAYING).result == OK
    assert person.step(1).result == Result.RESULT_OPERATION_FAILED


def test_a_reset_puts_the_robot_back_and_the_clock_goes_on(ros, person):
    clocks, odometry = [], []
    person.node.create_subscription(Clock, "/clock", clocks.append, qos.CLOCK)
    person.node.create_subscription(Odometry, topics.ODOMETRY, odometry.append, qos.SENSOR)
    node = ros.add(BurgerNode, start_paused=True, **DEMO)
    start = node.simulation.truth.pose
    assert ros.spin_until(lambda: node.count_subscribers(topics.ODOMETRY) > 0)
    assert person.place(start.x, start.y, start.yaw + 1.0).result == OK
    assert person.step(20).result == OK
    before = node.simulation.stamp
    assert person.reset().result == OK
    assert node.simulation.truth.pose.yaw == pytest.approx(start.yaw, abs=0.01)
    assert person.step(2).result == OK
    assert node.simulation.stamp == before + 100_000_000
    assert ros.spin_until(lambda: odometry and stamp_of(odometry[-1].header.stamp) > before)
    assert odometry[-1].pose.covariance[35] < odometry[-4].pose.covariance[35]
    stamps = [stamp_of(clock.clock) for clock in clocks]
    assert all(a < b for a, b in pairwise(stamps))
    refused = person.reset(ResetSimulation.Request.SCOPE_TIME)
    assert refused.result == Result.RESULT_FEATURE_UNSUPPORTED


def test_it_is_placed_on_free_ground_alone(ros, person):
    node = ros.add(BurgerNode, start_paused=True, **DEMO)
    start = node.simulation.truth.pose
    assert (
        person.place(start.x, start.y, start.yaw + 1.0, entity="burger", frame="world").result == OK
    )
    turned = node.simulation.truth.pose
    assert math.remainder(turned.yaw - start.yaw, math.tau) == pytest.approx(1.0)
    assert node.simulation.truth.distance == 0.0
    refusals = {
        person.place(0.0, 0.0, 0.0).result: Result.RESULT_OPERATION_FAILED,
        person.place(start.x, start.y, 0.0, entity="tree").result: Result.RESULT_NOT_FOUND,
        person.place(
            start.x, start.y, 0.0, frame="map"
        ).result: SetEntityState.Response.INVALID_POSE,
        person.place(math.nan, start.y, 0.0).result: SetEntityState.Response.INVALID_POSE,
    }
    assert all(found == wanted for found, wanted in refusals.items())
    assert node.simulation.truth.pose == turned


def test_its_speed_is_a_parameter_that_may_be_set(ros, person):
    node = ros.add(BurgerNode, family="demo", rate=0.01)
    stamp = node.simulation.stamp
    (result,) = node.set_parameters([Parameter("rate", value=0)])
    assert result.successful
    assert ros.spin_until(lambda: node.simulation.stamp > stamp + 10**9)
    (result,) = node.set_parameters([Parameter("rate", value=-1)])
    assert not result.successful


def test_it_tells_what_it_can_do(ros, person):
    ros.add(BurgerNode, start_paused=True)
    features = person.features()
    assert SimulatorFeatures.SIMULATION_STATE_PAUSE in features
    assert SimulatorFeatures.SPAWNING not in features


def test_time_passes_while_it_is_active(ros, person):
    node = ros.add(BurgerNode, autostart=False, **DEMO)

    def change(transition: int) -> bool:
        request = ChangeState.Request(transition=Transition(id=transition))
        return bool(person.call(ChangeState, "burger_node/change_state", request).success)

    stamp = node.simulation.stamp
    assert person.state() == PAUSED
    assert person.set_state(PLAYING).result == Result.RESULT_OPERATION_FAILED
    assert not change(Transition.TRANSITION_ACTIVATE)  # it is to be configured before
    assert change(Transition.TRANSITION_CONFIGURE)
    assert change(Transition.TRANSITION_ACTIVATE)
    assert ros.spin_until(lambda: node.simulation.stamp > stamp)
    assert change(Transition.TRANSITION_DEACTIVATE)
    stamp = node.simulation.stamp
    assert not ros.spin_until(lambda: node.simulation.stamp > stamp, timeout=0.3)
