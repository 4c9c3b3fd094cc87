"""What killed processes leave in shared memory goes with the next start; nothing else does."""

import fcntl
import mmap
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from rover_common.ros.shared_memory import FOLDER, NEW, remove_stale_memory

NODE = """
from rover_common.ros.fast_dds import use_profiles
use_profiles()
import rclpy, sys
rclpy.init(args=[], domain_id=int(sys.argv[1]))
node = rclpy.create_node("probe", enable_rosout=False)
print("ready", flush=True)
sys.stdin.read()
"""


def make(folder: Path, name: str, age: float = NEW + 5.0) -> list[Path]:
    paths = [folder / name, folder / f"{name}_el", folder / f"sem.{name}_mutex"]
    for path in paths:
        path.touch()
        os.utime(path, (time.time() - age,) * 2)
    return paths


def test_files_without_an_owner_go(tmp_path):
    make(tmp_path, "fastrtps_0123456789abcdef")
    make(tmp_path, "fastrtps_port7400")
    others = [tmp_path / "sem.mp-abc", tmp_path / "fastrtps_notes", tmp_path / "mine_el"]
    for path in others:
        path.touch()
    assert remove_stale_memory(tmp_path) == ["fastrtps_0123456789abcdef", "fastrtps_port7400"]
    assert set(tmp_path.iterdir()) == set(others)


@pytest.mark.parametrize("kind", [fcntl.LOCK_EX, fcntl.LOCK_SH])
def test_files_of_a_living_process_stay(tmp_path, kind):
    paths = make(tmp_path, "fastrtps_port7400")
    with paths[1].open("rb") as lock:
        fcntl.flock(lock, kind)
        assert remove_stale_memory(tmp_path) == []
    assert all(path.exists() for path in paths)


def test_a_port_without_locks_goes_when_no_process_has_it_any_more(tmp_path):
    port, other = make(tmp_path, "fastrtps_port7411")[0], make(tmp_path, "fastrtps_port7413")[0]
    for lock in tmp_path.glob("*_el"):
        lock.unlink()
    port.write_bytes(bytes(mmap.PAGESIZE))
    os.utime(port, (time.time() - 5.0,) * 2)
    with port.open("r+b") as file, mmap.mmap(file.fileno(), 0):
        assert remove_stale_memory(tmp_path) == [other.name]
        assert port.exists()
    assert remove_stale_memory(tmp_path) == [port.name]
    assert not any(tmp_path.iterdir())


def test_files_that_were_just_made_stay(tmp_path):
    paths = make(tmp_path, "fastrtps_port7400", age=0.0)
    assert remove_stale_memory(tmp_path) == []
    assert all(path.exists() for path in paths)


def test_no_folder_is_no_error(tmp_path):
    assert remove_stale_memory(tmp_path / "none") == []


def test_a_killed_node_leaves_memory_that_goes_and_a_living_one_keeps_its_own(monkeypatch):
    monkeypatch.setattr("rover_common.ros.shared_memory.NEW", -1.0)
    nodes = []
    for _ in range(2):
        before = set(FOLDER.glob("fastrtps_*"))
        domain = "44"
        process = subprocess.Popen(
            [sys.executable, "-c", NODE, domain], stdin=subprocess.PIPE, stdout=subprocess.PIPE
        )
        assert process.stdout is not None
        assert process.stdout.readline() == b"ready\n"
        nodes.append((process, owned(process.pid) - before))
    (killed, left), (living, kept) = nodes
    killed.send_signal(signal.SIGKILL)
    killed.wait(30)
    assert left
    assert all(path.exists() for path in left)
    remove_stale_memory()
    assert not [path for path in left if path.exists()]
    assert kept
    assert all(path.exists() for path in kept)
    living.communicate(timeout=30)


def owned(pid: int) -> set[Path]:
    """Of the memory that a process has mapped, that with its own lock: its segment."""
    held = {str(link.readlink()) for link in Path(f"/proc/{pid}/fd").iterdir() if link.exists()}
    return {Path(path) for path in held if path.startswith(f"{FOLDER}/fastrtps_")}
