"""A machine for the launcher to run on, on which chosen tools are missing."""

from __future__ import annotations

import os
import shutil
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
# What the launcher itself calls; the compiler, CMake and make are left out one at a time.
TOOLS = (
    "awk", "bash", "cat", "cut", "df", "dirname", "env", "find", "flock", "grep", "mkdir",
    "readlink", "rm", "sed", "sha256sum", "sort", "tail", "uname", "xargs",
)  # fmt: skip
BUILD_TOOLS = ("c++", "cmake", "make")
PYTHON = os.path.realpath(os.environ.get("VIRTUAL_ENV", "") + "/bin/python3")
STEPS = ("make_venv", "install_libraries", "prepare_ros", "build", "import_nodes")


class Machine:
    """A copy of the launcher in a folder of its own, with chosen tools on the path."""

    def __init__(self, folder: Path) -> None:
        self.root = folder / "a checkout"  # with a space
        self.bin = folder / "bin"
        self.bin.mkdir(parents=True)
        shutil.copytree(ROOT / "wheels", self.root / "wheels")
        tools, ours = ROOT / "rover_tools", self.root / "rover_tools"
        shutil.copytree(tools / "help", ours / "help")
        shutil.copytree(tools / "rover_tools" / "doctor", ours / "rover_tools" / "doctor")
        shutil.copy(tools / "rover_tools" / "__init__.py", ours / "rover_tools")
        shutil.copy(ROOT / "rover", self.root / "rover")
        for tool in (*TOOLS, *BUILD_TOOLS):
            found = shutil.which(tool)
            assert found, tool
            (self.bin / tool).symlink_to(found)

    def without(self, tool: str) -> None:
        (self.bin / tool).unlink()

    def fake(self, tool: str, script: str) -> None:
        (self.bin / tool).unlink(missing_ok=True)
        (self.bin / tool).write_text(f"#!/bin/sh\n{script}\n")
        (self.bin / tool).chmod(0o755)

    def replace_steps(self, body: str) -> None:
        """Each step of the set-up does this instead."""
        launcher = self.root / "rover"
        steps = "".join(f"{step}() {{ {body}; }}\n" for step in STEPS)
        launcher.write_text(launcher.read_text().replace("set_up() (\n", f"{steps}set_up() (\n"))

    def arguments_of(self, *arguments: str) -> list[str]:
        """What the launcher hands on, as one that is set up, on the platform noble."""
        launcher, python = self.root / "rover", self.root / ".noble" / ".venv" / "bin" / "python"
        python.parent.mkdir(parents=True)
        python.write_text('#!/bin/sh\nshift 2\nprintf "%s\\n" "$@"\n')
        python.chmod(0o755)
        set_up = 'set_up() { :; }\nenter_workspace() { :; }\ntake_platform "$@"\n'
        launcher.write_text(launcher.read_text().replace('take_platform "$@"\n', set_up))
        return self.rover(*arguments).stdout.splitlines()

    def rover(self, *arguments: str, **environment: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [str(self.root / "rover"), *arguments],
            env={"PATH": str(self.bin), "PYTHON": PYTHON, "HOME": "/nonexistent", **environment},
            capture_output=True,
            text=True,
            timeout=60,
        )
