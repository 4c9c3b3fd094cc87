"""Start, watch and end the processes of a run."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import time
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType

from rover_common.errors import RoverError
from rover_tools.output import note

LOG_LINES = 15  # of a dead process, shown to the user
STOP_SECONDS = 5.0  # [s] for a clean end after SIGINT
RESPAWNS = 5  # of one process in a run: one that dies more often is broken
# Where it is, a process gets SIGTERM when the one that started it is killed.
WITH_PARENT = ("setpriv", "--pdeathsig", "TERM", "--")


class ProcessDiedError(RoverError):
    """A process of the run ended before it was asked to."""


@dataclass
class _Child:
    name: str
    command: Sequence[str]
    process: subprocess.Popen[bytes]
    log: Path
    respawns: int = 0


class Processes:
    """The processes of one run; all of them end when the `with` block does."""

    def __init__(self, log_dir: Path, environment: Mapping[str, str]) -> None:
        self._log_dir = log_dir
        self._environment = {**os.environ, **environment}
        self._children: list[_Child] = []
        self._optional: set[str] = set()
        self._respawned: dict[str, int] = {}  # how often at most
        self._remarks: list[str] = []
        self._parent = WITH_PARENT if shutil.which(WITH_PARENT[0]) else ()
        self.stop_seconds = STOP_SECONDS
        log_dir.mkdir(parents=True, exist_ok=True)

    def start(self, name: str, command: Sequence[str]) -> None:
        """Start a command in a session of its own; its output goes to `<log_dir>/<name>.log`."""
        log = self._log_dir / f"{name}.log"
        log.unlink(missing_ok=True)
        self._children.append(_Child(name, command, self._spawn(command, log), log))

    def _spawn(self, command: Sequence[str], log: Path) -> subprocess.Popen[bytes]:
        with log.open("ab") as output:
            return subprocess.Popen(
                [*self._parent, *command],
                env=self._environment,
                stdin=subprocess.DEVNULL,
                stdout=output,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )

    def make_optional(self, name: str) -> None:
        """The run goes on when the named process ends."""
        self._optional.add(name)

    def respawn(self, names: Iterable[str], most: int = RESPAWNS) -> None:
        """From now on `check` starts these processes again when they have ended, so many times."""
        self._respawned |= dict.fromkeys(names, most)

    def check(self) -> None:
        """Start those again that are to be, and raise ProcessDiedError when another one has ended.

        Its message has the last lines of the process's log.
        """
        for child in self._children:
            code = child.process.poll()
            if code is None or child.name in self._optional:
                continue
            if child.respawns >= self._respawned.get(child.name, 0):
                raise ProcessDiedError(
                    f"{child.name} ended with exit code {code}; the end of {child.log}:\n"
                    + _tail(child.log)
                )
            self.remark(f"{child.name} ended with exit code {code}; it is started again")
            child.respawns += 1
            child.process = self._spawn(child.command, child.log)

    def respawns(self) -> dict[str, int]:
        """How often each process that ended was started again, until all are stopped."""
        return {child.name: child.respawns for child in self._children if child.respawns}

    def remark(self, text: str) -> None:
        """Tell it, and keep it for the result."""
        self._remarks.append(text)
        note(text)

    def remarks(self) -> dict[str, list[str]]:
        """For a result: `remarks`, as on what was started again; nothing where there are none."""
        return {"remarks": self._remarks} if self._remarks else {}

    def pid(self, name: str) -> int:
        """Of the named process."""
        return next(c for c in self._children if c.name == name).process.pid

    def ended(self, name: str) -> int | None:
        """The exit code of the named process, None while it runs."""
        return next(c for c in self._children if c.name == name).process.poll()

    def last_line(self, name: str) -> str:
        """The end of the named process's log."""
        return _tail(next(c for c in self._children if c.name == name).log).splitlines()[-1]

    def end(self, name: str) -> None:
        """SIGINT to the named process, and wait; SIGKILL if it does not end."""
        child = next(c for c in self._children if c.name == name)
        _signal(child.process, signal.SIGINT)
        _wait(child.process, self.stop_seconds)
        self._children.remove(child)

    def stop(self) -> None:
        """SIGINT to all, the last started first; SIGKILL to those that do not end."""
        for child in reversed(self._children):
            _signal(child.process, signal.SIGINT)
        deadline = time.monotonic() + self.stop_seconds
        for child in self._children:
            _wait(child.process, max(0.0, deadline - time.monotonic()))
        self._children.clear()

    def __enter__(self) -> Processes:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.stop()


def _signal(process: subprocess.Popen[bytes], number: signal.Signals) -> None:
    """Signal the process's whole session, as a terminal would."""
    if process.poll() is None:
        os.killpg(process.pid, number)


def _wait(process: subprocess.Popen[bytes], seconds: float) -> None:
    try:
        process.wait(seconds)
    except subprocess.TimeoutExpired:
        _signal(process, signal.SIGKILL)
        process.wait()


def _tail(log: Path) -> str:
    lines = log.read_text(errors="replace").splitlines()
    return "\n".join(lines[-LOG_LINES:]) or "(empty)"
