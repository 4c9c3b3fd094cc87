"""Mazes: what is promised of each, over many seeds."""

from __future__ import annotations

import math
from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest

from burger_simulator.world.drawing import draw_maze
from burger_simulator.world.families import FAMILIES
from burger_simulator.world.free_space import FreeSpace, distances_to_walls
from burger_simulator.world.generator import generate_maze
from burger_simulator.world.maze import Maze, MazeError, Wall
from rover_common.burger import BURGER
from rover_common.geometry import Pose

SEEDS = range(30)
ALL = [(family, seed) for family in FAMILIES for seed in SEEDS]


@pytest.fixture(scope="module")
def mazes() -> dict[tuple[str, int], Maze]:
    return {(family, seed): generate_maze(seed, family) for family, seed in ALL}


@pytest.mark.parametrize("family", FAMILIES)
def test_every_room_is_reached_by_a_disc_of_the_bodys_radius(family, mazes):
    for seed in SEEDS:
        maze = mazes[family, seed]
        space = FreeSpace(maze, BURGER.body_radius)
        # The sides of the ramp are narrower than the body, so the corner behind it is not reached.
        open_ground = space.free.copy()
        if maze.ramp is not None:
            rows, cols = np.indices(space.free.shape)
            along, _ = maze.ramp.along_and_across((cols + 0.5) * 0.02, (rows + 0.5) * 0.02)
            in_strip = (cols + 0.5) * 0.02 > maze.width - 1.02
            open_ground &= ~(in_strip & (along > -BURGER.body_radius))
        assert (space.reachable | ~open_ground).all(), maze.name
        assert space.reachable.sum() > 0.2 * space.free.size, maze.name


@pytest.mark.parametrize("family", [name for name, f in FAMILIES.items() if f.ramp])
def test_the_ramps_foot_is_reached_and_its_way_free(family, mazes):
    for seed in SEEDS:
        maze = mazes[family, seed]
        assert maze.ramp is not None
        space = FreeSpace(replace(maze, ramp=None), BURGER.body_radius)
        assert not FreeSpace(maze, BURGER.body_radius).reaches(maze.ramp.x, maze.ramp.y)
        for along in (-0.4, -0.2, 0.0, 0.6, maze.ramp.length):
            x = maze.ramp.x + along * math.cos(maze.ramp.yaw)
            y = maze.ramp.y + along * math.sin(maze.ramp.yaw)
            assert space.reaches(x, y), (maze.name, along)
    corners = {mazes[family, seed].ramp.corner for seed in SEEDS}
    assert corners == {"north-east", "south-east"}


@pytest.mark.parametrize("family", FAMILIES)
def test_sources_keep_their_distances_and_can_be_served(family, mazes):
    for seed in SEEDS:
        maze = mazes[family, seed]
        space = FreeSpace(maze, BURGER.body_radius)
        for first, second in combinations(maze.sources, 2):
            assert math.hypot(first.x - second.x, first.y - second.y) >= 0.8
        for source in maze.sources:
            ahead_x, ahead_y = math.cos(source.normal), math.sin(source.normal)
            on_wall = distances_to_walls(np.array(source.x), np.array(source.y), maze.walls)
            assert on_wall == pytest.approx(0.0025)
            if not source.at_ramp:
                assert space.reaches(source.x + 0.3 * ahead_x, source.y + 0.3 * ahead_y)
            left_x, left_y = -ahead_y, ahead_x
            for aside in (-0.19, 0.19):  # the wall goes on, and none stands on it
                x, y = source.x + aside * left_x, source.y + aside * left_y
                assert distances_to_walls(np.array(x), np.array(y), maze.walls) < 0.0026
                x, y = x + 0.01 * ahead_x, y + 0.01 * ahead_y
                assert distances_to_walls(np.array(x), np.array(y), maze.walls) > 0.009


def test_the_families_are_as_they_are_described(mazes):
    for (family, _), maze in mazes.items():
        fewest, most = FAMILIES[family].sources
        assert (maze.width, maze.height) == (FAMILIES[family].width, FAMILIES[family].height)
        assert (maze.ramp is not None) == FAMILIES[family].ramp
        assert fewest <= sum(not source.at_ramp for source in maze.sources) <= most
    with_one = [any(s.at_ramp for s in mazes["challenge", seed].sources) for seed in SEEDS]
    assert 0.3 < np.mean(with_one) < 0.7


def test_a_source_at_the_ramp_is_ahead_of_one_who_stands_on_it(mazes):
    found = 0
    for maze in mazes.values():
        for source in (s for s in maze.sources if s.at_ramp):
            along, across = maze.ramp.along_and_across(source.x, source.y)
            assert along == pytest.approx(maze.ramp.length + 0.25 - 0.0025)
            assert across == pytest.approx(0.0)
            assert math.cos(source.normal - maze.ramp.yaw) == pytest.approx(-1.0)
            found += 1
    assert found


def test_as_many_sources_as_asked_for():
    for count in (0, 1, 2, 4):
        maze = generate_maze(3, "challenge", sources=count)
        assert sum(not source.at_ramp for source in maze.sources) == count
    with pytest.raises(MazeError, match="room for 100 sources"):
        generate_maze(3, "demo", sources=100)
    with pytest.raises(MazeError, match="'canyon' is not one of challenge"):
        generate_maze(3, "canyon")


def test_a_saved_maze_is_the_same_again(tmp_path, mazes):
    for maze in list(mazes.values())[::17]:
        path = tmp_path / "worlds" / f"{maze.name}.yaml"
        maze.save(path)
        assert Maze.load(path) == maze


def test_a_file_that_is_no_maze_is_refused(tmp_path):
    path = tmp_path / "maze.yaml"
    for text in ("", "name: x", "- 1", ": :"):
        path.write_text(text)
        with pytest.raises(MazeError):
            Maze.load(path)
    with pytest.raises(MazeError):
        Maze.load(tmp_path / "missing.yaml")


def test_seeds_and_families_make_different_mazes(mazes):
    assert len({repr(maze) for maze in mazes.values()}) == len(mazes)
    assert generate_maze(5, "large") == generate_maze(5, "large")


def test_distances_to_walls_are_those_of_geometry():
    walls = (Wall(0.0, 0.0, 1.0, 0.0), Wall(3.0, 3.0, 3.0, 5.0))
    x, y = np.array([0.5, 2.0, -3.0, 2.0]), np.array([0.2, 0.0, 4.0, 4.0])
    assert distances_to_walls(x, y, walls).tolist() == pytest.approx([0.2, 1.0, 5.0, 1.0])


def test_a_drawing_shows_walls_ramp_and_sources():
    maze = replace(generate_maze(4), start=Pose(0.3, 0.5, 0.0))
    image = draw_maze(maze)
    assert image.shape == (348, 390, 3)
    colors = {tuple(color) for color in image.reshape(-1, 3).tolist()}
    assert {(240, 238, 232), (45, 50, 60), (215, 60, 40), (170, 180, 140)} <= colors
