"""What the mission decides, frame by frame and over whole missions."""

import dataclasses
import math

import numpy as np
import pytest
from rover import MIDDLE, PERIOD, PlanarRover, fly, rock, snapshot, straight_plan

from rover_common.geometry import Pose
from rover_common.types import GridMap
from rover_common.vehicle import MAX_STEERING
from rover_decision.config import DecisionConfig
from rover_decision.events import GAP_SECONDS, PLANS_WITHOUT_GOAL
from rover_decision.memory import Memory
from rover_decision.mission import Mission
from rover_decision.rocks import MOST_TRIES
from rover_decision.states import State
from rover_navigation.local_clearance import Terrain
from rover_navigation.monitors import CircleMonitor
from rover_navigation.path_tracking import follow
from rover_navigation.types import Goal, GoalKind, Way

CONFIG = DecisionConfig()
WALL_FOLLOWER = DecisionConfig(explorer="wall_follow_b")
PLAN = straight_plan()
EMPTY = GridMap(1.0, 0.0, 0.0, np.full((200, 200), -1, np.int8))


def test_it_drives_along_its_plan():
    mission = Mission(CONFIG)
    waiting = mission.tick(snapshot(1.0))
    assert (waiting.state, waiting.command.brake) == (State.FORWARD, 1.0)
    driving = mission.tick(snapshot(1.1, plan=PLAN))
    assert driving.command.throttle > 0
    assert driving.command.brake == 0


def test_a_way_behind_is_turned_to_on_the_spot_without_the_brake():
    mission = Mission(CONFIG)
    behind = straight_plan(pose=Pose(MIDDLE.x, MIDDLE.y, math.pi))
    mission.tick(snapshot(1.0))
    fast = mission.tick(snapshot(1.1, speed=1.0, plan=behind))
    assert fast.command.brake > 0
    standing = mission.tick(snapshot(1.2, plan=behind))
    assert standing.command.brake == standing.command.throttle == 0
    assert abs(standing.command.steering_angle) == pytest.approx(MAX_STEERING)


def test_bends_are_driven_slower_than_straights():
    angle = np.linspace(0, math.pi / 2, 12)
    bend = np.stack([MIDDLE.x + 4 * np.sin(angle), MIDDLE.y + 4 * (1 - np.cos(angle))], axis=1)
    way = Way(bend, np.full(len(bend), 5.0))
    terrain = Terrain.of(snapshot().scan, 0.5)
    around = follow(MIDDLE, 2.5, way, terrain, 4.0)
    straight = follow(MIDDLE, 2.5, PLAN.way, terrain, 4.0)
    assert straight.throttle > 0
    assert around.throttle < straight.throttle
    assert around.steering_angle > 0


def test_a_wall_ahead_stops_a_wall_follower_and_then_turns_it():
    mission = Mission(WALL_FOLLOWER)
    mission.tick(snapshot(1.0))
    fast = mission.tick(snapshot(1.1, ahead=1.0, speed=1.5))
    assert fast.state is State.STOP
    assert fast.command.brake > 0
    slow = mission.tick(snapshot(1.2, ahead=1.0, speed=0.0))
    assert slow.command.brake == slow.command.throttle == 0
    assert slow.command.steering_angle == pytest.approx(MAX_STEERING)
    assert mission.tick(snapshot(1.3)).state is State.FORWARD


def test_an_obstacle_on_the_way_stops_it_until_there_is_another_way():
    mission = Mission(CONFIG)
    mission.tick(snapshot(1.0, plan=PLAN))
    assert mission.tick(snapshot(1.1, ahead=1.0, speed=1.5, plan=PLAN)).state is State.STOP
    aside = straight_plan(pose=Pose(MIDDLE.x, MIDDLE.y, 1.0))
    turning = mission.tick(snapshot(1.2, ahead=1.0, plan=aside))
    assert turning.command.steering_angle == pytest.approx(MAX_STEERING)
    turned = Pose(MIDDLE.x, MIDDLE.y, 1.0)
    assert mission.tick(snapshot(2.0, turned, plan=aside)).state is State.FORWARD


def test_a_rock_is_approached_and_picked_up_only_when_standing():
    mission = Mission(CONFIG)
    rocks = (rock(103.0, 100.0),)
    mission.tick(snapshot(1.0, rocks=rocks))
    assert mission.tick(snapshot(1.1, rocks=rocks)).state is State.ROCK_APPROACH
    rolling = mission.tick(snapshot(1.9, rocks=rocks, near_sample=True, speed=0.4))
    assert rolling.state is State.PICKUP
    assert not rolling.command.pickup
    assert mission.tick(snapshot(2.1, rocks=rocks, near_sample=True)).command.pickup
    working = mission.tick(snapshot(2.2, rocks=rocks, near_sample=True, picking_up=True))
    assert not working.command.pickup
    done = mission.tick(snapshot(12.2, rocks=rocks, sample_count=2))
    assert done.state is State.FORWARD
    assert done.progress.samples_collected == 1


def test_a_rock_out_of_reach_is_given_up_tried_again_and_then_left():
    mission = Mission(CONFIG)
    rocks = (rock(103.0, 100.0),)
    approaches, before = 0, State.IDLE
    for step in range(1400):
        pose = Pose(100.0 + (step // 2 % 2), 100.0, 0.0)  # moves, so that it is not stuck
        state = mission.tick(snapshot(1.0 + step * 0.5, pose, rocks=rocks, plan=PLAN)).state
        approaches += state is State.ROCK_APPROACH and before is not state
        before = state
    assert approaches == MOST_TRIES


def test_before_a_rock_on_the_foot_of_a_wall_it_may_lean_further():
    states = {}
    for lean in (1.2, 1.8):  # of the limit
        mission = Mission(CONFIG)
        beside = (rock(MIDDLE.x + 2.0, MIDDLE.y),)
        mission.tick(snapshot(1.0, rocks=beside, plan=PLAN))
        assert mission.tick(snapshot(1.1, rocks=beside, plan=PLAN)).state is State.ROCK_APPROACH
        leaning = Pose(MIDDLE.x, MIDDLE.y, 0.0, roll=lean * CONFIG.tilt_limit)
        states[lean] = mission.tick(snapshot(1.2, leaning, rocks=beside, plan=PLAN)).state
    assert states == {1.2: State.ROCK_APPROACH, 1.8: State.TILT}


def test_a_rock_that_it_leans_too_far_before_again_and_again_is_given_up():
    mission = Mission(CONFIG)
    beside = (rock(MIDDLE.x + 2.0, MIDDLE.y),)
    state, tilts, time = State.FORWARD, 0, 1.0
    while time < 10.0 * CONFIG.rock_deadline:
        approaches = state is State.ROCK_APPROACH
        pose = Pose(MIDDLE.x, MIDDLE.y, 0.0, roll=0.3 if approaches else 0.0)
        decision = mission.tick(snapshot(time, pose, rocks=beside, plan=PLAN))
        tilts += decision.state is State.TILT and state is not State.TILT
        if decision.progress.rocks_given_up:
            break
        state, time = decision.state, time + 0.1
    assert decision.progress.rocks_given_up == 1
    assert tilts > 1
    assert time < 1.0 + 1.5 * CONFIG.rock_deadline


def test_samples_that_are_nowhere_are_looked_for_only_so_long():
    limit = CONFIG.search_limit
    plan = dataclasses.replace(PLAN, goal=Goal(GoalKind.SEARCH, 110.0, 100.0))
    first = snapshot(1.0, plan=plan)
    memory = Memory(CONFIG, first)
    memory.update(first, on_the_way_home=False)
    searches = {}
    for time in (2.0, 0.9 * limit, 1.1 * limit):
        now = snapshot(time, plan=plan)
        memory.update(now, on_the_way_home=False)
        searches[time] = memory.request(now, False)(EMPTY).search
    assert list(searches.values()) == [True, True, False]


def test_missing_frames_and_jumps_stop_it():
    for later in (
        snapshot(1.2 + GAP_SECONDS, speed=1.0, plan=PLAN),
        snapshot(1.2, Pose(120.0, 100.0, 0.0), speed=1.0, plan=PLAN),
    ):
        mission = Mission(CONFIG)
        mission.tick(snapshot(1.0, plan=PLAN))
        mission.tick(snapshot(1.1, plan=PLAN))
        decision = mission.tick(later)
        assert (decision.state, decision.command.brake) == (State.STOP, 1.0)


def test_steering_to_one_side_for_long_is_a_circle():
    monitor = CircleMonitor()
    for step in range(200):
        monitor.update(0.1 * step, 0.2, driving=True)
    assert monitor.circling(20.0)
    monitor.update(20.1, -0.2, driving=True)
    assert not monitor.circling(20.2)


def test_when_nothing_is_left_it_goes_home_and_stays():
    mission = Mission(CONFIG)
    for step in range(60):
        mission.tick(snapshot(1.0 + 0.2 * step, Pose(100.0 + 0.4 * step, 100.0, 0.0), plan=PLAN))
    far = Pose(123.6, 100.0, 0.0)
    for index in range(PLANS_WITHOUT_GOAL):
        empty = straight_plan(pose=far, stamp=1 + index, goal=False)
        turned = mission.tick(snapshot(13.0 + 0.1 * index, far, sample_count=0, plan=empty))
    assert turned.state is State.RETURN_HOME
    near = Pose(101.2, 100.0, math.pi)
    mission.tick(snapshot(14.0, far, sample_count=0, plan=empty))
    for step in range(25):  # no jumps
        pose = Pose(123.6 - 0.9 * step, 100.0, math.pi)
        home = mission.tick(snapshot(14.1 + 0.5 * step, pose, sample_count=0, plan=empty))
    home = mission.tick(snapshot(27.0, near, sample_count=0, plan=empty))
    assert home.state is State.DONE
    later = mission.tick(snapshot(27.5, near, sample_count=0, plan=empty))
    assert (later.command.brake, later.command.throttle) == (1.0, 0.0)
    assert mission.start()
    assert mission.state is State.IDLE


def test_when_the_time_is_up_it_goes_home():
    mission = Mission(DecisionConfig(time_limit=60.0))
    states = [
        mission.tick(snapshot(1.0 + step, Pose(100 + step, 100, 0), plan=PLAN)).state
        for step in range(40)
    ]
    assert State.RETURN_HOME in states


def test_without_ground_in_sight_it_brakes():
    mission = Mission(WALL_FOLLOWER)
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


def test_after_a_long_pause_it_goes_on_as_before():
    mission = Mission(CONFIG)
    mission.tick(snapshot(1.0, plan=PLAN))
    mission.pause()
    for time in np.arange(1.1, 60.0, 0.5):
        assert mission.tick(snapshot(time, plan=PLAN)).state is State.PAUSED
    mission.resume()
    states = {mission.tick(snapshot(60.0 + 0.1 * i, plan=PLAN)).state for i in range(19)}
    assert states == {State.FORWARD}


def test_a_wall_before_it_does_not_keep_it_from_looking_at_its_goal():
    at_the_end = straight_plan(length=1.0)
    aside = Goal(GoalKind.FRONTIER, MIDDLE.x, MIDDLE.y + 3.0)
    mission = Mission(CONFIG)
    mission.tick(snapshot(1.0))
    for time in np.arange(1.1, 3.0, 0.1):
        decision = mission.tick(
            snapshot(time, ahead=0.9, plan=dataclasses.replace(at_the_end, goal=aside))
        )
        assert decision.state is State.FORWARD
        assert decision.command.steering_angle > 0  # to the left, where the goal is
        assert decision.command.throttle == decision.command.brake == 0


def test_time_that_falls_back_starts_anew():
    mission = Mission(CONFIG)
    mission.tick(snapshot(500.0))
    mission.tick(snapshot(500.1, Pose(120, 100, 0)))
    again = mission.tick(snapshot(1.0))
    assert again.progress.elapsed == 0
    assert again.progress.distance == 0


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


@pytest.mark.parametrize("world", [RING, BENDS], ids=["ring", "bends"])
@pytest.mark.parametrize(
    ("explorer", "way_home"),
    [
        ("tour", "breadcrumbs"),
        ("tour", "shortest_path"),
        ("tour", "bearing"),
        ("frontier", "breadcrumbs"),
        ("wall_follow_a", "breadcrumbs"),
    ],
)
def test_a_mission_brings_all_samples_home(explorer, way_home, world):
    navigable, start, samples = world
    rover = PlanarRover(navigable, start, samples)
    mission, decision = fly(rover, DecisionConfig(explorer=explorer, way_home=way_home), 400)
    assert rover.samples == []
    assert rover.unsafe_pickups == 0
    assert mission.state is State.DONE
    assert decision.progress.home_distance < CONFIG.home_radius
    assert decision.progress.samples_collected == len(samples)
    assert PERIOD < decision.progress.elapsed < 400


def test_the_tour_sees_all_of_a_world():
    navigable, start, samples = BENDS
    rover = PlanarRover(navigable, start, samples)
    fly(rover, CONFIG, 400)
    free = rover.map().cells == 0
    assert np.count_nonzero(free) > 0.97 * 16 * np.count_nonzero(navigable)


def test_the_same_mission_twice():
    def track() -> list[Pose]:
        rover = PlanarRover(*BENDS[:2], samples=list(BENDS[2]))
        poses = []
        step = rover.step

        def recorded(command):
            step(command)
            poses.append(rover.pose)

        rover.step = recorded
        fly(rover, CONFIG, 60)
        return poses

    assert track() == track()


def test_before_it_gives_up_on_a_sample_it_takes_a_second_look_at_what_it_skipped():
    memory = Memory(CONFIG, snapshot())
    memory.block(MIDDLE, 1.0, 0.5, until=90.0)
    memory.block(MIDDLE, 1.0, 0.5, until=math.inf)
    assert memory.second_look(snapshot())
    assert [place.until for place in memory.blocked] == [math.inf]
    memory.block(MIDDLE, 1.0, 0.5, until=90.0)
    assert not memory.second_look(snapshot())  # so that a mission ends
