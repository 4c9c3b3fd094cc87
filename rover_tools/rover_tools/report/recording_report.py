"""What a recorded mission leaves to look at: track.csv, the video, and report.html."""

from __future__ import annotations

from pathlib import Path

from rover_tools.evaluation.results import Result, Truth
from rover_tools.report.map_layers import window_of
from rover_tools.report.mission_log import track_csv
from rover_tools.report.mission_page import mission_page
from rover_tools.report.recorded_mission import read_mission
from rover_tools.report.video.mission_video import VIDEO, write_video

TRACK = "track.csv"
REPORT = "report.html"
MOST_FRAMES = 300  # of a video: a longer mission is shown faster, and costs no more


def write_report(
    folder: Path, recording: Path, truth: Truth, title: str, result: Result | None = None
) -> Result:
    """Write the three files into the folder; a result that is not given is that of the recording.

    Returns the result. Raises RecordingError.
    """
    mission = read_mission(recording, truth)
    result = result or mission.result()
    log = mission.log(title, result)
    (folder / TRACK).write_text(track_csv(log.track))
    video = write_video(folder / VIDEO, mission.snapshots(MOST_FRAMES), window_of(log))
    (folder / REPORT).write_text(mission_page(log, video))
    return result
