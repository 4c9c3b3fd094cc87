"""Start commands, end them by signals at any time, and list what they leave behind.

Run by hand, on an idle machine:

./rover shell -c 'PYTHONPATH=tests:$PYTHONPATH python tests/starts_and_stops.py --times 50'
"""

from __future__ import annotations

import argparse
import os
import random
import signal
import subprocess
import sys
import tempfile
import time
import uuid
from contextlib import suppress
from itertools import cycle, islice, product
from pathlib import Path

from waiting import holds

from rover_common.ros.shared_memory import FOLDER, NEW, remove_stale_memory

ROVER = (sys.executable, "-m", "rover_tools.cli.main")
COMMANDS = {
    "mission": ("mission", "--seed", "3", "--size", "0.4", "--time-limit", "600"),
    "demo": ("demo", "--seed", "3"),
    "sim": ("sim", "--seed", "3"),
}
SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGKILL)
LATEST = 20.0  # [s] after the start, when a signal comes
END = 15.0  # [s] for all processes to end
MARK = "ROVER_STARTED_BY"  # in the environment of all processes of one start


class Started:
    """A command and all processes that it starts."""

    def __init__(self, name: str, folder: Path) -> None:
        self._mark = f"{MARK}={uuid.uuid4()}"
        out = () if name == "sim" else ("--out", str(folder))
        key, _, value = self._mark.partition("=")
        with (folder / "output.log").open("wb") as log:
            self.process = subprocess.Popen(
                [*ROVER, *COMMANDS[name], *out],
                env=os.environ | {key: value},
                stdin=subprocess.DEVNULL,
                stdout=log,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    def pids(self) -> list[int]:
        """Of all that live."""
        found = []
        for entry in Path("/proc").iterdir():
            with suppress(OSError):
                marked = entry.name.isdecimal() and self._mark.encode() in (
                    entry / "environ"
                ).read_bytes().split(b"\0")
                if marked:
                    found.append(int(entry.name))
        return found

    def memory(self) -> set[Path]:
        """The shared memory that its processes have open."""
        files: set[Path] = set()
        for pid in self.pids():
            with suppress(OSError):
                for line in Path(f"/proc/{pid}/maps").read_text().splitlines():
                    path = line.split()[-1]
                    if path.startswith(f"{FOLDER}/fastrtps_") and "port" not in path:
                        files.add(Path(path))
        return files

    def end(self, number: int) -> list[str]:
        """Signal the command alone, as a person or an init system does; what is left."""
        memory = self.memory()
        self.process.send_signal(number)
        if not holds(lambda: self.process.poll() is not None and not self.pids(), END):
            return [f"process {pid}: {_command_line(pid)}" for pid in self.pids()]
        if number == signal.SIGKILL:  # what the next start removes
            holds(lambda: not remove(memory), 2 * NEW)
        return [str(path) for path in memory if path.exists()]

    def kill(self) -> None:
        """Whatever is left."""
        for pid in self.pids():
            with suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        self.process.wait()


def remove(memory: set[Path]) -> list[Path]:
    """Remove what killed processes left; which files stay."""
    remove_stale_memory()
    return [path for path in memory if path.exists()]


def _command_line(pid: int) -> str:
    with suppress(OSError):
        return Path(f"/proc/{pid}/cmdline").read_text().replace("\0", " ")
    return "ended"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--times", type=int, default=50)
    options = parser.parse_args()
    moments, left = random.Random(1), 0
    for name, number in islice(cycle(product(COMMANDS, SIGNALS)), options.times):
        with tempfile.TemporaryDirectory() as folder:
            started = Started(name, Path(folder))
            seconds = moments.uniform(0.1, LATEST)
            time.sleep(seconds)
            found = started.end(number)
            started.kill()
        left += len(found)
        what = "; ".join(found) or "nothing"
        print(f"{name}, {number.name} after {seconds:.1f} s: {what} is left", flush=True)
    print(f"{options.times} starts, {left} processes and files left", flush=True)
    return int(left > 0)


if __name__ == "__main__":
    sys.exit(main())
