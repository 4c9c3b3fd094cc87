"""Remove the shared memory that processes have left behind.

Fast DDS keeps segments and ports as files; each is locked by the process that owns it. One that
ends with SIGKILL leaves 8 MB in memory for each of its contexts. Of every process, the port that it
was reached by stays, without locks; whoever gets it next has the settings of the one before.
"""

from __future__ import annotations

import fcntl
import os
import time
from contextlib import ExitStack, suppress
from pathlib import Path

FOLDER = Path("/dev/shm")
LOCKS = ("_el", "_sl")  # exclusive, and shared by the readers of a port
NEW = 10.0  # [s] a file may exist for a moment before it is locked
NEW_PORT = 1.0  # [s] the same, before it is mapped


def remove_stale_memory(folder: Path = FOLDER) -> list[str]:
    """Remove what belongs to processes of this user that have ended; returns its names."""
    names = {lock.name[: -len(end)] for end in LOCKS for lock in folder.glob(f"fastrtps_*{end}")}
    removed = [name for name in sorted(names) if _removed(folder, name)]
    return removed + _remove_ports(folder, names)


def _remove_ports(folder: Path, locked: set[str]) -> list[str]:
    """Those without a lock that no process maps, as one does that has sent something there."""
    found = sorted(folder.glob("fastrtps_port*"))
    ports = [path for path in found if path.name not in locked and not path.name.endswith(LOCKS)]
    if not ports:
        return []
    mapped = _mapped()
    removed = []
    for path in ports:
        with suppress(OSError):
            status = path.stat()
            old = time.time() - status.st_mtime >= NEW_PORT
            if old and status.st_uid == os.getuid() and str(path) not in mapped:
                path.unlink()
                (folder / f"sem.{path.name}_mutex").unlink(missing_ok=True)
                removed.append(path.name)
    return removed


def _mapped() -> set[str]:
    """Paths of the ports that living processes have in their memory."""
    found = set()
    for maps in Path("/proc").glob("[0-9]*/maps"):
        with suppress(OSError):  # it has ended, or is another user's
            lines = maps.read_text(errors="replace").splitlines()
            found |= {line.split(maxsplit=5)[5] for line in lines if "/fastrtps_port" in line}
    return found


def _removed(folder: Path, name: str) -> bool:
    locks = [path for end in LOCKS if (path := folder / f"{name}{end}").exists()]
    with ExitStack() as stack:
        try:
            for lock in locks:
                file = stack.enter_context(lock.open("rb"))
                status = os.fstat(file.fileno())
                if status.st_uid != os.getuid() or time.time() - status.st_mtime < NEW:
                    return False
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            for path in (folder / name, folder / f"sem.{name}_mutex", *locks):
                path.unlink(missing_ok=True)
        except OSError:  # locked by its owner, or another process was faster
            return False
    return True
