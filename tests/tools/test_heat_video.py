"""The video of a heat mission, and what it takes from the closed loop."""

from __future__ import annotations

import numpy as np
import pytest
from heat_logs import COLD, OVERLAY, WARM, moment_at
from heat_runs import MAZE, START, map_of

from burger_simulator.world.generator import generate_maze
from rover_common.geometry import Pose, distance_between
from rover_heat.types import HeatOverlay
from rover_tools.evaluation.heat_run import run_heat_mission
from rover_tools.evaluation.heat_setup import HeatSetup
from rover_tools.report.heat_log import BLANK
from rover_tools.report.heat_steps import StepWatch
from rover_tools.report.map_layers import Window
from rover_tools.report.video.canvas import Canvas
from rover_tools.report.video.colours import (
    BLUE,
    GREEN,
    GROUND,
    INK,
    OBSTACLE,
    ORANGE,
    PAGE,
    UNKNOWN,
    VERMILLION,
    colour_of,
)
from rover_tools.report.video.composition import HEIGHT, WIDTH, Composition
from rover_tools.report.video.heat_scene import HeatScene, HeatSnapshot, thermal_picture

WINDOW = Window(0.0, -4.0, 4.0, 4.0)  # the room
SCALE = 80  # [px/m] of the map


def snapshot_at(time: float, **changes) -> HeatSnapshot:
    cells = np.zeros((40, 40))
    cells[19] = 100  # the west wall of the room
    values = {"moment": moment_at(time), "grid": map_of(cells), "overlay": OVERLAY}
    return HeatSnapshot(**values | changes)


def scene() -> HeatScene:
    return HeatScene(WINDOW, MAZE, START)


def near(picture: np.ndarray, column: float, row: float, colour: tuple) -> bool:
    """Whether the colour is within two pixels of a place."""
    column, row = round(column), round(row)
    part = picture[max(0, row - 2) : row + 3, max(0, column - 2) : column + 3]
    return bool((part == colour).all(axis=2).any())


def test_a_frame_is_thermal_frames_maze_figures_and_map():
    frame = Composition(scene()).frame(snapshot_at(10.0))
    assert frame.shape == (HEIGHT, WIDTH, 3)
    assert frame[20, 20].sum() < 60  # sensor 1 is cold
    assert frame[70, 290].sum() > 200  # sensor 2's warm pixel, in the second column from the right
    assert (frame[192, 20] == BLUE).all()  # exploring


def test_a_thermal_frame_is_shown_from_its_median_on():
    picture = thermal_picture(WARM, 160)
    assert picture[70, 130].sum() > picture[70, 30].sum() + 200
    assert (thermal_picture(COLD + 5.0, 160) == thermal_picture(COLD, 160)).all()
    assert (thermal_picture(BLANK, 160) == PAGE).all()


def test_the_map_is_turned_into_the_mazes_frame():
    picture = scene().map(snapshot_at(0.0))
    at = lambda x, y: (x * SCALE, 20 + (4.0 - y) * SCALE)  # noqa: E731
    assert near(picture, *at(0.025, 1.5), OBSTACLE)
    assert near(picture, *at(0.5, 1.5), GROUND)
    assert near(picture, *at(2.5, 1.5), UNKNOWN)  # beyond the map
    assert near(picture, *at(3.0, 3.97), GREEN)  # a source that is not served yet
    assert near(picture, *at(1.0, 1.0), INK)  # the robot


def test_the_true_maze_has_its_sources_and_examined_faces():
    picture = scene().panels(snapshot_at(0.0))[:, 320:]
    at = lambda x, y: (80 + x * 40, (4.0 - y) * 40)  # noqa: E731
    assert near(picture, *at(0.15, 2.0), VERMILLION)
    assert near(picture, *at(0.01, 1.5), GREEN)  # a face that was examined
    assert near(picture, *at(0.01, 2.5), ORANGE)  # one that was not
    assert (HeatScene(WINDOW).panels(snapshot_at(0.0))[:, 320:] == PAGE).all()


def test_a_canvas_that_is_not_turned_is_as_before():
    cells = np.zeros((4, 4))
    cells[3, 0] = 100  # the north-west corner
    grid = map_of(cells)
    picture = Canvas(Window(0.0, -0.2, 0.2, 0.2), 40, 40).cells(grid)
    assert (picture[:10, :10] == OBSTACLE).all()
    assert ((picture == OBSTACLE).all(axis=2)).sum() == 100


def test_nothing_known_yet_is_a_frame_too():
    blank = moment_at(0.0, thermal=(BLANK, BLANK), state="INITIALIZING")
    frame = Composition(scene()).frame(HeatSnapshot(blank, None, HeatOverlay()))
    assert frame.shape == (HEIGHT, WIDTH, 3)


def test_a_long_reason_ends_before_the_clock():
    short, long = (
        Composition(scene()).frame(snapshot_at(5.0, moment=moment_at(5.0, reason=reason)))
        for reason in ("waits", "waits " * 40)
    )
    assert (short[180:210, 565:] == long[180:210, 565:]).all()
    assert (short[180:210, 200:500] != long[180:210, 200:500]).any()


def test_states_of_a_heat_mission_differ_in_colour():
    states = ("EXPLORING", "GOAL_NAVIGATION", "LAUNCHING", "ATTEMPTING_RAMP", "TILT_INTERRUPT")
    assert len({colour_of(state) for state in states}) == len(states)


@pytest.fixture(scope="module")
def watched() -> tuple:
    """Ten seconds of a mission."""
    maze = generate_maze(1, "demo")
    watch = StepWatch(maze.start)
    setup = HeatSetup.of(time_limit=10.0)
    return maze, watch, run_heat_mission(maze, 1, setup, watch), setup


def test_the_loop_leaves_a_log_and_a_snapshot_a_second(watched):
    maze, watch, run, _ = watched
    assert distance_between(run.map_in_world, maze.start) < 1e-4
    watch.end(run.grid, run.overlay)
    log = watch.log.log("t", run.grid, run.overlay, {})
    seconds = int(run.time)
    assert len(watch.snapshots) >= seconds
    assert len(log.track) >= seconds
    assert np.isfinite(log.excess[1:]).all()
    assert max(point.position_error for point in log.track if point.position_error) < 0.05
    assert 0.0 < log.track[-1].tilt < 0.05  # the stance of the robot
    assert watch.snapshots[-1].moment.time == pytest.approx(log.track[-1].time, abs=1e-3)


def test_the_same_mission_is_the_same_run(watched):
    maze, _, run, setup = watched
    again = run_heat_mission(maze, 1, setup)
    assert np.array_equal(again.ticks.true, run.ticks.true)
    assert np.array_equal(again.ticks.estimated, run.ticks.estimated, equal_nan=True)


def test_faces_stay_when_a_plan_has_none():
    watch = StepWatch(Pose(0.0, 0.0, 0.0))
    watch.with_faces(OVERLAY)
    assert len(watch.with_faces(HeatOverlay()).faces) == len(OVERLAY.faces)
