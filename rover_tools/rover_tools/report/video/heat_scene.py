"""What a video shows of a heat mission: thermal frames, the true maze, the map, its figures."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from burger_simulator.world.maze import Maze
from rover_common.geometry import Pose, compose_points, inverse
from rover_common.types import GridMap
from rover_heat.thermal.picture import Celsius, picture_of
from rover_heat.types import HeatOverlay
from rover_tools.report.heat_drawing import disc_of, patch_of, ramp_parts
from rover_tools.report.heat_log import ORIGIN, HeatMoment
from rover_tools.report.map_layers import Window
from rover_tools.report.video.canvas import Canvas, TrackMemory
from rover_tools.report.video.colours import (
    BLUE,
    GREEN,
    INK,
    MUTED,
    ORANGE,
    PAGE,
    PURPLE,
    VERMILLION,
    YELLOW,
)
from rover_tools.report.video.composition import MAP, PANELS
from rover_tools.report.video.lettering import write
from rover_tools.report.video.snapshot import Image

THERMAL = 160  # [px] edge of a thermal picture
RING = 6.0 * np.array([(np.cos(a), np.sin(a)) for a in np.linspace(0.0, 2.0 * np.pi, 17)])  # [px]


@dataclass(frozen=True)
class HeatSnapshot:
    """A heat mission at one moment."""

    moment: HeatMoment
    grid: GridMap | None
    overlay: HeatOverlay


class HeatScene:
    """Takes one snapshot after another of one mission."""

    def __init__(self, window: Window, maze: Maze | None = None, frame: Pose = ORIGIN) -> None:
        """frame: the map's, in the frame of window and maze."""
        self._maze, self._to_map = maze, inverse(frame)
        self._map = Canvas(window, *MAP, frame)
        self._truth = Canvas(window, PANELS[0] - 2 * THERMAL, PANELS[1], frame)
        self._track = TrackMemory()

    def panels(self, snapshot: HeatSnapshot) -> Image:
        frames = [thermal_picture(frame, THERMAL) for frame in snapshot.moment.thermal]
        for number, picture in enumerate(frames, 1):
            cv2.rectangle(picture, (0, 0), (THERMAL - 1, THERMAL - 1), MUTED, 1)
            where = (8, THERMAL - 10)
            write(picture, f"sensor {number}", where, 11, MUTED)
        return np.hstack([*frames, self._true_maze(snapshot)])

    def map(self, snapshot: HeatSnapshot) -> Image:
        canvas, overlay = self._map, snapshot.overlay
        self._track.add(snapshot.moment)
        picture = canvas.cells(snapshot.grid)
        for strip in overlay.hazards.strips:
            canvas.line(picture, strip.corners(), PURPLE, 1, closed=True)
        for disc in overlay.hazards.discs:
            canvas.line(picture, disc_of(disc.x, disc.y, disc.radius), PURPLE, 1, closed=True)
        self._track.draw(canvas, picture, width=1)
        for delivered, colour in ((False, GREEN), (True, BLUE)):
            places = [(s.x, s.y) for s in overlay.sources if s.delivered == delivered]
            canvas.symbols(picture, np.array(places).reshape(-1, 2), RING, colour)
        if overlay.goal is not None:
            goal = np.array([(overlay.goal.x, overlay.goal.y)])
            canvas.symbols(picture, goal, RING / 2, YELLOW)
        canvas.robot(picture, snapshot.moment.pose)
        return picture

    def figures(self, snapshot: HeatSnapshot) -> list[tuple[str, str]]:
        moment = snapshot.moment
        return [
            ("explored", f"{100.0 * moment.explored:.0f} %"),
            ("sources", str(moment.sources_known)),
            ("served", str(moment.sources_delivered)),
            ("payloads", str(moment.payloads)),
            ("speed", f"{round(moment.speed, 2) + 0.0:.2f} m/s"),  # no -0.00
            ("driven", f"{moment.distance:.1f} m"),
        ]

    def _true_maze(self, snapshot: HeatSnapshot) -> Image:
        """With the walls' faces that were examined; dark where it is not known."""
        canvas, maze = self._truth, self._maze
        picture = np.full((PANELS[1], PANELS[0] - 2 * THERMAL, 3), PAGE, np.uint8)
        if maze is None:
            return picture
        parts = zip(ramp_parts(maze.ramp) if maze.ramp else [], (60, 110, 60), strict=False)
        for part, grey in parts:
            canvas.area(picture, compose_points(self._to_map, part), (grey, grey, grey // 2))
        for source in maze.sources:
            canvas.area(picture, compose_points(self._to_map, patch_of(source)), VERMILLION)
        for wall in maze.walls:
            ends = np.array([(wall.x0, wall.y0), (wall.x1, wall.y1)])
            canvas.line(picture, compose_points(self._to_map, ends), MUTED, 1)
        for faces, colour in (
            (snapshot.overlay.open_faces, ORANGE),
            (snapshot.overlay.faces, GREEN),
        ):
            for column, row in np.round(canvas.pixels(faces)).astype(int).tolist():
                cv2.circle(picture, (column, row), 1, colour, cv2.FILLED)
        pose = snapshot.moment.pose
        canvas.line(picture, disc_of(pose.x, pose.y, 0.15), INK, 1, closed=True)
        return picture


def thermal_picture(celsius: Celsius, size: int) -> Image:
    """(size, size, 3) RGB of a frame; dark for none."""
    if np.isnan(celsius).any():
        return np.full((size, size, 3), PAGE, np.uint8)
    how = cv2.INTER_NEAREST
    return np.asarray(cv2.resize(picture_of(celsius), (size, size), interpolation=how), np.uint8)
