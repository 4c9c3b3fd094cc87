"""What the mission decides, frame by frame and over whole missions."""

import dataclasses
import math

import numpy as np
import pytest
from rover import MIDDLE, PERIOD, PlanarRover, fly, rock, snapshot, straight_plan

from rover_common.dataflow import GridMap
from rover_common.geometry import Pose
from rover_common.vehicle import MAX_STEERING
from rover_decision.config import DecisionConfig
from rover_decision.follower import follow
from rover_decision.memory import ON_ONE_SPOT, STOPS_HERE, Memory
from rover_decision.mission import GAP_SECONDS, PLANS_WITHOUT_GOAL, Mission
from rover_decision.observers import HELD_SECONDS, CircleMonitor, ProgressMonitor
from rover_decision.planning.dataflow import NO_WAY, Goal, GoalKind, Way
from rover_decision.recovery import LADDER
from rover_decision.rocks import MOST_TRIES
from rover_decision.states import State
from rover_decision.terrain import Terrain

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


def test_the_faster_it_drives_the_more_room_it_needs():
    def state(ahead: float, speed: float) -> State:
        mission = Mission(CONFIG)
        mission.tick(snapshot(1.0))
        return mission.tick(snapshot(1.1, ahead=ahead, speed=speed, plan=PLAN)).state

    assert state(1.2, speed=0.4) is State.FORWARD
    assert state(1.2, speed=2.0) is State.STOP
    assert state(3.0, speed=2.0) is State.FORWARD


def test_too_near_to_an_obstacle_for_the_way_it_backs_up_and_goes_on():
    mission = Mission(CONFIG)
    mission.tick(snapshot(1.0))
    for time in np.arange(1.1, 3.0, 0.1):
        near = mission.tick(snapshot(time, ahead=0.8, plan=PLAN))
    assert near.state is State.STOP
    assert near.command.throttle < 0
    away = mission.tick(snapshot(3.0, pose=Pose(99.6, 100.0, 0.0), ahead=1.2, plan=PLAN))
    assert away.state is State.FORWARD
    assert away.command.throttle > 0


def test_where_it_stops_again_and_again_the_way_is_blocked():
    mission = Mission(CONFIG)
    mission.tick(snapshot(1.0))
    time, stops = 1.0, 0
    while stops < STOPS_HERE:
        for ahead in (0.8, 1.2):  # it backs up and sets out again
            before = mission.state
            for _ in range(8):
                time += 0.1
                mission.tick(snapshot(time, ahead=ahead, plan=PLAN))
            stops += mission.state is State.STOP and before is not State.STOP
        assert len(mission.memory.blocked) == (stops == STOPS_HERE)
    (place,) = mission.memory.blocked
    assert place.x > MIDDLE.x
    assert math.isfinite(place.until)


def test_a_rover_that_is_held_is_stuck_soon_and_one_that_waits_is_not():
    mission = Mission(CONFIG)
    waiting = [mission.tick(snapshot(1.0 + 0.1 * step)).state for step in range(25)]
    assert State.STUCK not in waiting  # for the first plan, with the brake on
    driving = [mission.tick(snapshot(3.5 + 0.1 * step, plan=PLAN)).state for step in range(30)]
    assert driving.index(State.STUCK) == pytest.approx(10 * HELD_SECONDS, abs=2)


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


def test_no_progress_is_stuck_and_leads_to_backing_up_and_in_the_end_home():
    mission = Mission(CONFIG)
    decisions, blocked = [], False
    for step in range(1500):
        decisions.append(mission.tick(snapshot(1.0 + 0.1 * step, plan=PLAN)))
        blocked |= len(mission.memory.blocked) > 0
    stuck = [decision for decision in decisions if decision.state is State.STUCK]
    assert stuck[0].command.throttle < 0
    assert blocked
    last = decisions[-1]
    assert last.progress.recoveries > len(LADDER)
    assert any("home" in decision.reason for decision in decisions) or last.state is State.DONE


def test_a_tilt_stops_backs_off_and_marks_the_place():
    mission = Mission(CONFIG)
    for step in range(10):
        mission.tick(snapshot(1.0 + 0.1 * step, Pose(99.0 + 0.1 * step, 100, 0), plan=PLAN))
    leaning = Pose(100, 100, 0, pitch=-0.3)
    fast = mission.tick(snapshot(2.0, pose=leaning, speed=1.0, plan=PLAN))
    assert fast.state is State.TILT
    assert fast.command.brake == 1.0
    assert mission.tick(snapshot(2.1, pose=leaning, plan=PLAN)).command.throttle < 0
    (place,) = mission.memory.blocked
    assert place.until == math.inf
    level = Pose(99.2, 100, 0)
    assert mission.tick(snapshot(3.0, pose=level, plan=PLAN)).state is State.FORWARD


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


def test_to_turn_to_and_fro_on_one_spot_is_no_progress():
    """Each turn is progress for itself, and so is each change between FORWARD and STOP."""
    mission = Mission(CONFIG)
    states = []
    for time in np.arange(1.0, 1.5 * ON_ONE_SPOT, 0.1):
        yaw = 2.0 * math.sin(0.8 * time)
        ahead = 0.5 if math.sin(0.4 * time) > 0 else 10.0
        plan = straight_plan(pose=Pose(MIDDLE.x, MIDDLE.y, yaw))
        pose = Pose(MIDDLE.x, MIDDLE.y, yaw)
        states.append(mission.tick(snapshot(time, pose, ahead, plan=plan)).state)
    assert {State.FORWARD, State.STOP} < set(states)
    assert states.index(State.STUCK) > 10 * 0.8 * ON_ONE_SPOT


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


def test_a_plan_that_cannot_place_the_rover_never_ends_the_exploration():
    mission = Mission(CONFIG)
    mission.tick(snapshot(1.0, plan=PLAN))
    states = set()
    for index in range(4 * PLANS_WITHOUT_GOAL):
        unplaced = dataclasses.replace(straight_plan(stamp=1 + index, goal=False), placed=False)
        decision = mission.tick(snapshot(1.5 + 0.1 * index, plan=unplaced))
        states.add(decision.state)
    assert State.RETURN_HOME not in states
    assert State.STUCK in states  # it moves, so that the map gets ground to plan on


def test_a_rover_that_is_shut_in_on_the_map_has_not_explored_all():
    mission = Mission(CONFIG)
    shut_in = dataclasses.replace(straight_plan(goal=False), home_way=NO_WAY, home_seconds=math.inf)
    mission.tick(snapshot(1.0))
    mission.memory.block_ahead(1.0, MIDDLE)
    states = []
    for step in range(60):
        yaw = math.radians(5 * step)  # it looks around
        now = snapshot(1.1 + 0.1 * step, Pose(MIDDLE.x, MIDDLE.y, yaw), sample_count=0,
            plan=dataclasses.replace(shut_in, stamp=1 + step))  # fmt: skip
        states.append(mission.tick(now).state)
    assert State.RETURN_HOME not in states
    assert State.STUCK in states
    assert mission.memory.blocked == ()


def test_before_it_gives_up_on_a_sample_it_takes_a_second_look_at_what_it_skipped():
    memory = Memory(CONFIG, snapshot())
    memory.block(MIDDLE, 1.0, 0.5, until=90.0)
    memory.block(MIDDLE, 1.0, 0.5, until=math.inf)
    assert memory.second_look(snapshot())
    assert [place.until for place in memory.blocked] == [math.inf]
    memory.block(MIDDLE, 1.0, 0.5, until=90.0)
    assert not memory.second_look(snapshot())  # so that a mission ends
