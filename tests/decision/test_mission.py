"""What the mission decides, frame by frame and over whole missions."""

import math

import numpy as np
import pytest
from rover import PERIOD, PlanarRover, rock, snapshot

from rover_common.geometry import Pose
from rover_common.vehicle import MAX_STEERING
from rover_decision.config import DecisionConfig
from rover_decision.crumbs import Crumbs
from rover_decision.mission import Mission
from rover_decision.observers import ProgressMonitor
from rover_decision.states import State
from rover_decision.terrain import Terrain

CONFIG = DecisionConfig()


def test_open_ground_is_driven_on():
    mission = Mission(CONFIG)
    decision = mission.tick(snapshot())
    assert decision.state is State.FORWARD
    assert decision.command.throttle > 0
    assert decision.command.brake == 0


def test_a_wall_ahead_stops_and_then_turns_without_the_brake():
    mission = Mission(CONFIG)
    mission.tick(snapshot(1.0))
    fast = mission.tick(snapshot(1.1, ahead=1.0, speed=1.5))
    assert fast.state is State.STOP
    assert fast.command.brake > 0
    slow = mission.tick(snapshot(1.2, ahead=1.0, speed=0.0))
    assert slow.command.brake == slow.command.throttle == 0
    assert slow.command.steering_angle == pytest.approx(MAX_STEERING)
    free = mission.tick(snapshot(1.3))
    assert free.state is State.FORWARD


def test_a_rock_is_approached_and_picked_up_only_when_standing():
    mission = Mission(CONFIG)
    rocks = (rock(104.0, 100.0),)
    mission.tick(snapshot(1.0, rocks=rocks))
    assert mission.tick(snapshot(1.1, rocks=rocks)).state is State.ROCK_APPROACH
    rolling = mission.tick(snapshot(2.0, rocks=rocks, near_sample=True, speed=0.4))
    assert rolling.state is State.PICKUP
    assert not rolling.command.pickup
    assert mission.tick(snapshot(2.1, rocks=rocks, near_sample=True)).command.pickup
    working = mission.tick(snapshot(2.2, rocks=rocks, near_sample=True, picking_up=True))
    assert not working.command.pickup
    done = mission.tick(snapshot(12.2, rocks=rocks, sample_count=2))
    assert done.state is State.FORWARD
    assert done.progress.samples_collected == 1


def test_a_rock_out_of_reach_is_given_up_and_tried_again():
    mission = Mission(CONFIG)
    rocks = (rock(104.0, 100.0),)
    states = []
    for step in range(400):
        time = 1.0 + step * 0.5
        pose = Pose(100.0 + (step % 2) * 2, 100.0, 0.0)  # moves, so that it is not stuck
        states.append(mission.tick(snapshot(time, pose, rocks=rocks)).state)
    given_up = states.index(State.FORWARD, 5)
    assert given_up * 0.5 >= CONFIG.rock_deadline - 1
    assert State.ROCK_APPROACH in states[given_up + 10 :]


def test_no_progress_is_stuck_and_leads_to_backing_up():
    mission = Mission(CONFIG)
    commands = [mission.tick(snapshot(1.0 + 0.1 * step)) for step in range(100)]
    stuck = [decision for decision in commands if decision.state is State.STUCK]
    assert stuck
    assert stuck[0].command.throttle < 0
    assert commands[-1].state is not State.STUCK or len(stuck) < 60


def test_a_tilt_backs_off_at_once():
    mission = Mission(CONFIG)
    mission.tick(snapshot(1.0))
    tilted = mission.tick(snapshot(1.1, pose=Pose(100, 100, 0, pitch=-0.3)))
    assert tilted.state is State.TILT
    assert tilted.command.throttle < 0


def test_when_all_is_collected_it_goes_home_and_stays():
    mission = Mission(CONFIG)
    for step in range(60):
        mission.tick(snapshot(1.0 + 0.2 * step, Pose(100.0 + 0.4 * step, 100.0, 0.0)))
    turned = mission.tick(snapshot(13.2, Pose(123.6, 100.0, 0.0), sample_count=0))
    assert turned.state is State.RETURN_HOME
    home = mission.tick(snapshot(60.0, Pose(100.5, 100.0, math.pi), sample_count=0))
    assert home.state is State.DONE
    later = mission.tick(snapshot(61.0, Pose(100.5, 100.0, math.pi), sample_count=0))
    assert later.command.brake > 0
    assert later.command.throttle == 0


def test_without_ground_in_sight_it_brakes():
    mission = Mission(CONFIG)
    mission.tick(snapshot(1.0))
    assert mission.tick(snapshot(1.1, ahead=0.0)).command.throttle <= 0


def test_requests():
    mission = Mission(CONFIG)
    mission.tick(snapshot(1.0))
    assert mission.pause()
    paused = mission.tick(snapshot(1.1))
    assert (paused.state, paused.command.brake) == (State.PAUSED, 1.0)
    assert mission.resume()
    assert mission.tick(snapshot(1.2)).state is State.FORWARD
    assert mission.return_home()
    assert mission.state is State.RETURN_HOME


def test_time_that_falls_back_starts_anew():
    mission = Mission(CONFIG)
    mission.tick(snapshot(500.0))
    mission.tick(snapshot(500.1, Pose(120, 100, 0)))
    again = mission.tick(snapshot(1.0))
    assert again.progress.elapsed == 0
    assert again.progress.distance == 0


def test_crumbs_cut_loops_out():
    crumbs = Crumbs()
    for angle in np.linspace(0, 2 * math.pi, 60):  # a loop that comes back to its beginning
        crumbs.drop(Pose(10 + 5 * math.sin(angle), 15 - 5 * math.cos(angle), 0))
    crumbs.drop(Pose(9.0, 10.0, 0))
    way = crumbs.way_home(Pose(9.0, 10.0, 0))
    assert len(way) < 6
    assert np.hypot(*(way[-1] - (10, 10))) < 0.1


def test_stuck_needs_the_whole_span():
    monitor = ProgressMonitor(5.0)
    for step in range(49):
        monitor.update(0.1 * step, Pose(0, 0, 0))
    assert not monitor.stuck()
    for step in range(49, 55):
        monitor.update(0.1 * step, Pose(0, 0, 0))
    assert monitor.stuck()
    monitor.restart()
    assert not monitor.stuck()


def test_a_corridor_is_as_long_as_its_nearest_obstacle():
    scan = snapshot(ahead=6.0).scan
    scan.ranges[50:58] = 3.0  # right ahead
    terrain = Terrain.of(scan, 0.5)
    assert terrain.clearance(0.0) == pytest.approx(3.0, abs=0.05)
    assert terrain.clearance(math.radians(40)) == pytest.approx(6.0, abs=0.2)
    assert abs(terrain.best_bearing(0.0, 5.0)) > math.radians(5)


def ring() -> np.ndarray:
    """A closed corridor of 6 m around a block."""
    cells = np.zeros((200, 200), bool)
    cells[80:121, 80:121] = True
    cells[86:115, 86:115] = False
    return cells


def bends() -> np.ndarray:
    """A winding dead end."""
    cells = np.zeros((200, 200), bool)
    cells[95:102, 80:111] = True
    cells[95:121, 104:111] = True
    cells[114:121, 104:131] = True
    return cells


RING = (ring(), Pose(83.0, 100.0, 1.57), [(83.0, 110.0), (100.0, 118.5)])
BENDS = (bends(), Pose(83.0, 98.5, 0.0), [(95.0, 100.5), (125.0, 117.0)])


@pytest.mark.parametrize(
    ("explorer", "navigable", "start", "samples"),
    [("wall_follow_a", *RING), ("wall_follow_a", *BENDS), ("wall_follow_b", *RING)],
    ids=["a-ring", "a-bends", "b-ring"],
)
def test_a_mission_brings_all_samples_home(explorer, navigable, start, samples):
    rover = PlanarRover(navigable, start, samples)
    mission = Mission(DecisionConfig(explorer=explorer))
    decision = None
    while rover.time < 400 and mission.state is not State.DONE:
        decision = mission.tick(rover.look())
        rover.step(decision.command)
    assert decision is not None
    assert rover.samples == []
    assert rover.unsafe_pickups == 0
    assert mission.state is State.DONE
    assert decision.progress.home_distance < CONFIG.home_radius
    assert decision.progress.samples_collected == len(samples)
    assert PERIOD < decision.progress.elapsed < 400
