"""Plans: frontiers, tours, ways, crumbs, and when a plan takes effect."""

from __future__ import annotations

import itertools
import math
import threading

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from rover import rock, straight_plan

from rover_common.geometry import Pose
from rover_common.grid import GridGeometry
from rover_common.map_encoding import EDGE
from rover_common.types import GridMap
from rover_navigation.breadcrumb_path import way_over_crumbs
from rover_navigation.breadcrumbs import Crumbs
from rover_navigation.costmap import Blocked, Costmap
from rover_navigation.frontiers import find_frontiers
from rover_navigation.path_smoothing import SLOWEST, drivable_way
from rover_navigation.plan_scheduler import PlanDesk
from rover_navigation.planner import Planner
from rover_navigation.tour import MOST_STOPS, tour_costs
from rover_navigation.types import GoalKind, PlanRequest, Searched

HERE = Pose(20.0, 20.0, 0.0)
NOWHERE = np.empty((0, 2))
NOT_VISITED = np.empty((0, 3))


def grid(*free: tuple[float, float, float, float], walls: bool = True) -> GridMap:
    """A map of 60 x 60 m: free rectangles (x0, y0, x1, y1) [m], walls of 1 m around them."""
    cells = np.full((240, 240), -1, np.int8)
    margin = 1.0 if walls else 0.0
    for x0, y0, x1, y1 in free:
        rows, cols = (_cells(a - margin, b + margin) for a, b in ((y0, y1), (x0, x1)))
        cells[rows, cols] = 100
    for x0, y0, x1, y1 in free:
        cells[_cells(y0, y1), _cells(x0, x1)] = 0
    return GridMap(0.25, 0.0, 0.0, cells)


def _cells(low: float, high: float) -> slice:
    return slice(round(low * 4), round(high * 4))


def opened(map_: GridMap, x0: float, y0: float, x1: float, y1: float, value: int = -1) -> GridMap:
    """The same map with a part of it unknown, or of another value."""
    cells = map_.cells.copy()
    cells[_cells(y0, y1), _cells(x0, x1)] = value
    return GridMap(map_.resolution, 0.0, 0.0, cells)


HALL = grid((10, 15, 40, 25))
OPEN_EAST = opened(HALL, 40, 16, 41, 24)  # a door in the east wall


def request(map_: GridMap, **changes) -> PlanRequest:
    fields = {
        "stamp": 7, "grid": map_, "pose": HERE, "home": (12.0, 20.0), "trail": NOWHERE,
        "rocks": (), "blocked": (), "visited": NOT_VISITED, "doubtful": NOT_VISITED,
        "searched": None, "search": False, "last_goal": None,
    }  # fmt: skip
    return PlanRequest(**(fields | changes))


def plan(map_: GridMap, explorer: str = "tour", **changes):
    return Planner(explorer).plan(request(map_, **changes))


def test_a_closed_room_leaves_nothing_to_do():
    made = plan(HALL)
    assert made.goal is None
    assert made.explored == 1.0
    assert np.hypot(*(made.home_way.points[-1] - (12.0, 20.0))) < 0.5


def test_a_door_into_the_unknown_is_the_goal():
    made = plan(OPEN_EAST)
    assert made.goal is not None
    assert made.goal.kind is GoalKind.FRONTIER
    assert made.goal.x == pytest.approx(40, abs=0.5)
    assert len(made.frontiers) == 1
    assert np.all(np.diff(made.way.points[:, 0]) >= 0)  # straight to it
    assert made.explored < 1.0


def test_a_border_too_short_for_a_way_on_is_no_goal():
    assert plan(opened(HALL, 40, 19.25, 41, 20.75)).goal is None
    assert plan(opened(HALL, 40, 18.5, 41, 21.5)).goal is not None


def test_places_visited_in_vain_are_no_goals():
    made = plan(OPEN_EAST, visited=np.array([[39.9, y, 1.5] for y in np.arange(16, 25)]))
    assert made.goal is None


def test_what_was_in_vain_before_is_tried_again_only_where_that_costs_little():
    before = np.array([[40.0, 20.0, 2.0]])
    near, far = Pose(36.0, 20.0, 0.0), Pose(14.0, 20.0, 0.0)
    for pose, tried in ((near, True), (far, False)):
        home = (pose.x, pose.y)
        made = plan(OPEN_EAST, doubtful=before, pose=pose, home=home)
        assert (made.goal is not None) is tried
        assert plan(OPEN_EAST, pose=pose, home=home).goal is not None


def test_many_small_patches_do_not_keep_a_large_one_from_being_looked_at():
    patches = HALL
    for x in np.arange(13.0, 26.0, 3.0):  # each takes more time to stop at than it is worth
        patches = opened(patches, x, 16, x + 1.0, 17)
    assert plan(patches).goal is None
    large = plan(opened(patches, 30, 18, 36, 22))
    assert large.goal is not None
    assert large.goal.x > 29.0


def test_the_hidden_side_of_an_obstacle_is_kept_away_from():
    rock_seen = opened(HALL, 30, 19.75, 30.5, 20.25, 100)
    with_shadow = opened(rock_seen, 30.5, 19.75, 32.5, 20.25)

    def room(map_: GridMap, x: float) -> tuple[float, float]:
        costmap = Costmap.of(map_, NOWHERE, (12.0, 20.0))
        cell = costmap.geometry.cell_of(x, 20.0)
        return float(costmap.clearance[cell]), float(costmap.room[cell])

    assert room(with_shadow, 31.25) == (0.0, 0.0)  # within a metre of the rock: it may be the rock
    assert min(room(with_shadow, 32.25)) > 0.5
    assert min(room(rock_seen, 31.25)) > 0.5
    clearance, care = room(opened(rock_seen, 30.5, 19.75, 32.5, 20.25, EDGE), 31.25)
    assert clearance > 0.5  # an edge was seen, only not well
    assert care == 0.0


def with_edge(x0: float, x1: float) -> GridMap:
    """The hall with a piece of its south wall seen from afar only."""
    return opened(HALL, x0, 14, x1, 15, EDGE)


def test_a_wall_seen_from_afar_is_looked_at_where_that_costs_little():
    on_the_way = plan(with_edge(14, 22), pose=Pose(36.0, 17.0, math.pi), home=(12.0, 17.0))
    assert on_the_way.goal is not None
    assert on_the_way.goal.y == pytest.approx(15, abs=0.5)
    off_the_way = plan(with_edge(34, 38), pose=Pose(12.0, 20.0, 0.0), home=(12.0, 20.0))
    assert off_the_way.goal is None
    assert len(off_the_way.frontiers) == 1  # it is still shown
    as_wide_a_door = opened(HALL, 34, 14, 38, 15)
    assert plan(as_wide_a_door, pose=Pose(12.0, 20.0, 0.0), home=(12.0, 20.0)).goal is not None


def test_an_unknown_patch_amid_known_ground_is_worth_what_it_can_hide():
    def worth(size: float) -> float:
        patch = opened(HALL, 30, 18, 30 + size, 18 + size)
        costmap = Costmap.of(patch, NOWHERE, (12.0, 20.0))
        return sum(frontier.hides for frontier in find_frontiers(costmap, NOT_VISITED))

    assert worth(2.0) == pytest.approx(0.5 * 2.0**2)
    assert worth(4.0) == pytest.approx(0.5 * 4.0**2)
    assert find_frontiers(Costmap.of(OPEN_EAST, NOWHERE, (12, 20)), NOT_VISITED)[0].hides > 1e9


def test_blocked_places_are_driven_around():
    middle = Blocked(30.0, 20.0, 2.0)
    way = plan(OPEN_EAST, blocked=(middle,)).way.points
    assert np.hypot(way[:, 0] - 30, way[:, 1] - 20).min() > 2.0


def test_ground_behind_a_gap_too_narrow_is_looked_at_from_before_it():
    narrow = grid((10, 15, 30, 25), (30, 19.75, 34, 20.25), (34, 15, 37, 25))
    made = plan(opened(narrow, 37, 16, 38, 24))
    assert made.goal is not None
    assert made.way.points[-1, 0] < 31.0


def test_a_rock_on_the_way_comes_first_and_one_off_the_way_later():
    near = plan(OPEN_EAST, rocks=(rock(28.0, 20.0, 3),))
    assert (near.goal.kind, near.goal.rock_id) == (GoalKind.ROCK, 3)
    behind = plan(OPEN_EAST, rocks=(rock(12.0, 20.0, 4),))  # at home: on the way back
    assert behind.goal.kind is GoalKind.FRONTIER
    assert plan(HALL, rocks=(rock(50.0, 50.0),)).goal is None  # out of reach


def test_the_nearest_frontier_or_the_shortest_tour():
    """A short arm to the west, where home is, and a long one to the east."""
    two = opened(opened(HALL, 40, 16, 41, 24), 9, 16, 10, 24)
    at = Pose(23.0, 20.0, math.pi)
    assert plan(two, "frontier", pose=at).goal.x < 15
    assert plan(two, "tour", pose=at, home=(10.5, 20.0)).goal.x > 35


def test_the_unsearched_is_the_goal_when_rocks_are_missing():
    from rover_navigation.monitors import SearchedGround

    searched = SearchedGround().so_far()
    assert plan(HALL, search=True, searched=searched).goal.kind is GoalKind.SEARCH
    assert plan(HALL, search=False, searched=searched).goal is None


def test_the_foot_of_a_wall_is_searched_like_the_ground_before_it():
    geometry = GridGeometry.of_world(1.0)
    looked = np.full((geometry.rows, geometry.cols), 2.0, np.float32)
    assert plan(HALL, search=True, searched=Searched(geometry, looked)).goal is None
    looked[20, 40] = 8.0  # half a metre into the east wall
    made = plan(HALL, search=True, searched=Searched(geometry, looked))
    assert (made.goal.x, made.goal.y) == (40.5, 20.5)
    assert np.hypot(*(made.way.points[-1] - (40.5, 20.5))) < 2.0
    looked[20, 40], looked[20, 41] = 2.0, 8.0  # deeper than a foot reaches
    assert plan(HALL, search=True, searched=Searched(geometry, looked)).goal is None


def test_on_an_empty_map_it_looks_around_from_where_it_stands():
    made = plan(GridMap(0.25, 0.0, 0.0, np.full((240, 240), -1, np.int8)))
    assert made.goal is not None
    assert np.hypot(made.goal.x - HERE.x, made.goal.y - HERE.y) < 2.0
    assert len(made.home_way) == 0


@settings(max_examples=40, deadline=None)
@given(st.integers(1, 6), st.integers(0, 10_000))
def test_tours_are_the_shortest(count, seed):
    random = np.random.default_rng(seed)
    first, last = random.uniform(1, 50, count), random.uniform(1, 50, count)
    between = random.uniform(1, 50, (count, count))
    worth = np.where(random.random(count) < 0.5, np.inf, random.uniform(-3, 60, count))
    costs = tour_costs(first, between, last, worth)
    for start in range(count):
        others = [stop for stop in range(count) if stop != start]
        orders = [
            (start, *rest)
            for length in range(count)
            for rest in itertools.permutations(others, length)
        ]
        onward = [sum(between[a, b] for a, b in itertools.pairwise(order)) for order in orders]
        missed = [sum(worth[stop] for stop in others if stop not in order) for order in orders]
        best = min(
            first[start] + seconds + last[order[-1]] + missing
            for order, seconds, missing in zip(orders, onward, missed, strict=True)
        )
        assert costs[start] == pytest.approx(best)


def staircase(corner: float) -> np.ndarray:
    """East, then north: cells' centres around a right angle at (corner, 20) [m]."""
    east = [(x, 20.0) for x in np.arange(12.0, corner, 0.5)]
    return np.array(east + [(corner, y) for y in np.arange(20.0, 24.0, 0.5)])


def sharpest(points: np.ndarray) -> float:
    """The largest turn [rad] between two steps."""
    heading = np.unwrap(np.arctan2(*np.diff(points, axis=0).T[::-1]))
    return float(np.abs(np.diff(heading)).max())


def test_a_way_is_rounded_off_where_there_is_room_and_keeps_its_ends():
    open_hall = Costmap.of(HALL, NOWHERE, (12.0, 20.0))
    narrow = Costmap.of(grid((10, 19, 30.75, 21), (29, 15, 31, 25)), NOWHERE, (12.0, 20.0))
    raw = staircase(30.0)
    wide_way, narrow_way = drivable_way(raw, open_hall), drivable_way(raw, narrow)
    for way in (wide_way, narrow_way):
        assert np.allclose(way.points[[0, -1]], raw[[0, -1]])
    assert sharpest(raw) == pytest.approx(math.pi / 2)
    assert sharpest(wide_way.points) < math.radians(15)
    assert sharpest(wide_way.points) < sharpest(narrow_way.points) / 1.5
    assert wide_way.speeds.min() > narrow_way.speeds.min() >= SLOWEST


@pytest.mark.parametrize("count", [0, 1, 2, 3, 4])
def test_a_way_may_be_short(count):
    raw = staircase(30.0)[:count]
    way = drivable_way(raw, Costmap.of(HALL, NOWHERE, (12.0, 20.0)))
    assert np.allclose(way.points, raw)
    assert len(way.speeds) == count


def test_too_many_stops_are_refused():
    count = MOST_STOPS + 1
    with pytest.raises(ValueError, match="at most"):
        tour_costs(np.ones(count), np.ones((count, count)), np.ones(count), np.ones(count))


def test_crumbs_cut_loops_out():
    crumbs = Crumbs()
    for angle in np.linspace(0, 2 * math.pi, 60):  # a loop that comes back near its beginning
        crumbs.drop(Pose(20 + 5 * math.sin(angle), 20 - 5 * math.cos(angle), 0))
    costmap = Costmap.of(HALL, crumbs.points, (20, 15))
    way = way_over_crumbs(crumbs.points, crumbs.points[-1], costmap)
    assert len(way) < 6
    assert np.hypot(*(way[-1] - crumbs.points[0])) < 0.1


def test_crumbs_do_not_cut_through_walls():
    around = grid((10, 10, 40, 14), (36, 10, 40, 30), (10, 26, 40, 30))
    trail = np.array([(x, 12.0) for x in np.arange(12, 38)] + [(38.0, y) for y in range(12, 28)])
    trail = np.concatenate([trail, [(x, 28.0) for x in np.arange(38, 12, -1.0)]])
    way = way_over_crumbs(trail, (13.0, 28.0), Costmap.of(around, trail, (13.0, 28.0)))
    assert np.hypot(*np.diff(way, axis=0).T).sum() > 55
    assert way[:, 0].max() > 35


def test_crumbs_lead_around_a_place_where_the_rover_got_stuck():
    loop = [(20.0, y) for y in np.arange(16, 25)] + [(x, 24.0) for x in np.arange(21, 31)]
    loop += [(30.0, y) for y in np.arange(23, 16, -1.0)] + [
        (x, 17.0) for x in np.arange(29, 20, -1)
    ]
    trail = np.array(loop, float)
    here = (28.0, 17.0)
    free = way_over_crumbs(trail, here, Costmap.of(HALL, trail, here))
    assert free[:, 1].max() < 18.0
    stuck = Costmap.of(HALL, trail, here, (Blocked(24.0, 17.0, 1.0),))
    around = way_over_crumbs(trail, here, stuck)
    assert np.hypot(*(around - (24.0, 17.0)).T).min() > 1.0
    assert np.hypot(*(around[-1] - trail[0])) < 0.1


def test_a_rock_beside_the_trail_stays_on_the_map():
    beside = opened(HALL, 30, 20.5, 31, 21.5, 100)
    trail = np.array([(x, 20.0) for x in np.arange(12, 38, 0.5)])
    costmap = Costmap.of(beside, trail, (37.0, 20.0))
    assert not costmap.free[costmap.geometry.cell_of(30.5, 20.6)]
    assert costmap.free[costmap.geometry.cell_of(30.5, 20.1)]


class TestDesk:
    """Plans take effect at a defined frame."""

    @pytest.fixture
    def gate(self):
        gate = threading.Event()
        gate.set()
        return gate

    @pytest.fixture(params=[True, False], ids=["lockstep", "live"])
    def desk(self, request, gate):
        def make(asked: PlanRequest):
            assert gate.wait(10)
            return straight_plan(stamp=asked.stamp)

        desk = PlanDesk(make, delay=0.3, lockstep=request.param)
        self.lockstep = request.param
        yield desk
        gate.set()
        desk.close()

    def ask(self, desk: PlanDesk, stamp: int) -> None:
        desk.ask(stamp, lambda map_: request(map_, stamp=stamp))

    def test_not_before_its_frame(self, desk, gate):
        self.ask(desk, 1_000_000_000)
        desk.give_map(1_000_000_000, HALL)
        assert desk.plan_at(1_200_000_000) is None
        desk.close()  # it is made by now
        assert desk.plan_at(1_300_000_000).stamp == 1_000_000_000

    def test_the_map_may_come_before_the_frame_asks(self, desk, gate):
        desk.give_map(1_000_000_000, HALL)
        self.ask(desk, 1_000_000_000)
        assert not desk.must_wait(2_000_000_000)

    def test_only_lockstep_waits(self, desk, gate):
        self.ask(desk, 1_000_000_000)
        assert desk.must_wait(1_400_000_000) == self.lockstep
        assert not desk.must_wait(1_200_000_000)
        gate.clear()
        desk.give_map(1_000_000_000, HALL)
        assert not desk.must_wait(1_400_000_000)
        if not self.lockstep:
            assert desk.plan_at(1_400_000_000) is None  # not made yet: go on with what there is
