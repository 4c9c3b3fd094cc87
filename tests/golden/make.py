"""Record the drive of the golden replay: python tests/golden/make.py

It renders a drive through a generated canyon with the embedded simulator and keeps every fifth
frame. The frames are committed, so that the replay does not depend on the renderer.
"""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path

from rover_simulator.recordings.recorder import record_drive
from rover_simulator.recordings.recording import LOG_NAME

FOLDER = Path(__file__).parent / "drive"
SEED = 1  # two samples of this canyon come into view on the drive
RECORDED = 300  # frames, 0.1 m apart
EVERY = 5


def main() -> None:
    shutil.rmtree(FOLDER, ignore_errors=True)
    (FOLDER / "IMG").mkdir(parents=True)
    with tempfile.TemporaryDirectory() as temporary:
        drive = record_drive(Path(temporary), SEED, RECORDED)
        header, *rows = (drive.folder / LOG_NAME).read_text().splitlines()
        kept = rows[::EVERY]
        for row in kept:
            name = row.split(";", 1)[0]
            shutil.copyfile(drive.folder / name, FOLDER / name)
    (FOLDER / LOG_NAME).write_text("\n".join([header, *kept]) + "\n")


if __name__ == "__main__":
    main()
