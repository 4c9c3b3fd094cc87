"""Record the example of the documentation: python docs/examples/make.py

The embedded simulator renders a drive through a canyon that it has generated. The files are
committed, so that the commands of the documentation run as they are written.
"""

from __future__ import annotations

import shutil
import tempfile
from pathlib import Path

from rover_simulator.recordings.recorder import record_drive

FOLDER = Path(__file__).parent
SEED = 2031  # no result or test uses this canyon; a sample comes into view on the drive
FRAMES = 200  # 0.1 m apart


def main() -> None:
    shutil.rmtree(FOLDER / "recording", ignore_errors=True)
    with tempfile.TemporaryDirectory() as temporary:
        drive = record_drive(Path(temporary), SEED, FRAMES)
        for source, name in ((drive.truth, "map.png"), (drive.samples, "samples.csv")):
            shutil.move(source, FOLDER / name)
        shutil.rmtree(drive.folder / "world")
        shutil.copytree(drive.folder, FOLDER / "recording")


if __name__ == "__main__":
    main()
