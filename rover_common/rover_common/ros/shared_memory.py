"""Remove the shared memory that killed processes have left behind.

Fast DDS keeps segments and ports as files; each is locked by the process that owns it. One that
ends with SIGKILL leaves 8 MB in memory for each of its contexts.
"""

from __future__ import annotations

import fcntl
import os
import time
from contextlib import ExitStack
from pathlib import Path

FOLDER = Path("/dev/shm")
LOCKS = ("_el", "_sl")  # exclusive, and shared by the readers of a port
NEW = 10.0  # [s] a file may exist for a moment before it is locked


def remove_stale_memory(folder: Path = FOLDER) -> list[str]:
    """Remove what belongs to processes of this user that have ended; returns its names."""
    names = {lock.name[: -len(end)] for end in LOCKS for lock in folder.glob(f"fastrtps_*{end}")}
    return [name for name in sorted(names) if _removed(folder, name)]


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
