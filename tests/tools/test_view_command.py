"""`rover view`: each failure in one line; test_view.py of the dashboard shows the page."""

from __future__ import annotations

from pathlib import Path

import pytest
from recordings_by_hand import write_recording

from rover_tools.cli.main import main


@pytest.mark.parametrize(
    ("name", "content", "text"),
    [
        ("missing", None, "does not exist"),
        ("empty", "", "holds no recording"),
        ("notes.mcap", "some text", "notes.mcap"),
    ],
)
def test_what_is_no_recording_is_one_line(tmp_path: Path, capsys, name, content, text):
    path = tmp_path / name
    if content == "":
        path.mkdir()
    elif content:
        path.write_text(content)
    assert main(["view", str(path)]) != 0
    said = capsys.readouterr().err
    assert text in said
    assert "Traceback" not in said


def test_a_recording_without_a_rover_is_one_line(tmp_path: Path, capsys):
    assert main(["view", str(write_recording(tmp_path / "run"))]) == 1
    assert capsys.readouterr().err == "rover view: the recording has no topic odom\n"
