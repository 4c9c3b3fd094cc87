"""What a recorded mission leaves to look at: track.csv, the video, and report.html."""

from __future__ import annotations

from pathlib import Path

from rover_common.whole_file import write_whole
from rover_tools.evaluation.results import Result, Truth
from rover_tools.report.mission_log import track_csv
from rover_tools.report.mission_page import mission_page
from rover_tools.report.recorded_mission import read_mission
from rover_tools.report.rover_drawing import window_of
from rover_tools.report.video.mission_video import MOST_FRAMES, VIDEO, write_video
from rover_tools.report.video.rover_scene import RoverScene

TRACK = "track.csv"
REPORT = "report.html"


def write_report(
    folder: Path, recording: Path, truth: Truth, title: str, result: Result | None = None
) -> Result:
    """Write the three files into the folder; a result that is not given is that of the recording.

    Returns the result. Raises RecordingError.
    """
    mission = read_mission(recording, truth)
    result = result or mission.result()
    log = mission.log(title, result)
    write_whole(folder / TRACK, track_csv(log.track))
    scene = RoverScene(window_of(log))
    video = write_video(folder / VIDEO, mission.snapshots(MOST_FRAMES), scene)
    write_whole(folder / REPORT, mission_page(log, video))
    return result
