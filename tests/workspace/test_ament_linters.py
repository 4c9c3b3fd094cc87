"""The linters of ROS 2 for what ruff does not read; skipped where they are not installed.

ament_flake8 and ament_pep257 want another style than ruff's formatter writes, and are not used.
"""

from __future__ import annotations

import shutil
import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = sorted({path.parent for path in ROOT.glob("*/package.xml")})


@pytest.mark.parametrize("linter", ["ament_xmllint", "ament_lint_cmake"])
def test_the_packages_pass(linter):
    program = shutil.which(linter)
    if program is None:
        pytest.skip(f"{linter} is not installed")
    done = subprocess.run([program, *map(str, FOLDERS)], capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
