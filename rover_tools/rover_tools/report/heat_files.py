"""What a heat mission leaves to look at: maps, track.csv, the video, and report.html."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from rover_common.whole_file import write_whole
from rover_tools.evaluation.map_files import save_map_server_pair
from rover_tools.evaluation.results import Result
from rover_tools.report.heat_drawing import window_of
from rover_tools.report.heat_log import HeatLog, heat_track_csv
from rover_tools.report.heat_page import heat_map, heat_maze, heat_page
from rover_tools.report.heat_truth import MAZE, HeatTruth
from rover_tools.report.recorded_heat import read_heat_mission
from rover_tools.report.recording_report import REPORT, TRACK
from rover_tools.report.video.heat_scene import HeatScene, HeatSnapshot
from rover_tools.report.video.mission_video import MOST_FRAMES, VIDEO, evenly, write_video


def write_heat_report(
    folder: Path, recording: Path, title: str, truth: HeatTruth, result: Result | None = None
) -> Result:
    """Write the files of a recorded mission; a result that is not given is the mission's own.

    Returns the result. Raises RecordingError.
    """
    mission = read_heat_mission(recording, truth)
    result = result or mission.result()
    log = mission.builder.log(
        title, mission.grid, mission.overlay, result, truth.maze, truth.map_in_world,
        truth.launches,
    )  # fmt: skip
    write_heat_files(folder, log, mission.snapshots)
    return result


def write_heat_files(folder: Path, log: HeatLog, snapshots: Sequence[HeatSnapshot]) -> None:
    """Write them into the folder; the maze as well, where it is known."""
    if log.maze is not None:
        log.maze.save(folder / MAZE)
    if log.grid is not None:
        save_map_server_pair(log.grid, folder / "map")
    write_whole(folder / "map.svg", heat_map(log))
    maze = heat_maze(log)
    if maze is not None:
        write_whole(folder / "maze.svg", maze)
    write_whole(folder / TRACK, heat_track_csv(log.track))
    video = None
    if snapshots:
        scene = HeatScene(window_of(log), log.maze, log.map_in_world)
        chosen = (snapshots[number] for number in evenly(MOST_FRAMES, len(snapshots)))
        video = write_video(folder / VIDEO, chosen, scene)
    write_whole(folder / REPORT, heat_page(log, video))
