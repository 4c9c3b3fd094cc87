"""Folders with a blank in their name: what the set-up repairs."""

from __future__ import annotations

import os
import subprocess
import sys
import sysconfig
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PYTHON = os.path.realpath(sys.executable)


def test_the_wheels_cmake_files_are_repaired_below_a_blank(tmp_path):
    venv = tmp_path / "a checkout" / ".venv"
    cmake = venv / "share" / "some_msgs" / "cmake" / "export.cmake"
    cmake.parent.mkdir(parents=True)
    cmake.write_text("set(dirs /opt/python/cp311-cp311/include/python3.11)\n")
    generators = {}
    for name in ("rosidl_typesupport_cpp", "rosidl_typesupport_c"):
        generators[name] = venv / "share" / name / "cmake" / f"{name}-extras.cmake"
        generators[name].parent.mkdir(parents=True)
        generators[name].write_text('ament_register_extension(\n  "rosidl")\n')
    (venv / "bin").mkdir()
    (venv / "bin" / "python").symlink_to(PYTHON)
    (venv / "numpy.py").write_text("def get_include(): return '/numpy/include'\n")
    subprocess.run(
        ["bash", str(ROOT / "wheels" / "make_underlay.sh"), str(venv)],
        env={**os.environ, "PYTHONPATH": str(venv)}, check=True,
    )  # fmt: skip
    assert cmake.read_text() == f"set(dirs {sysconfig.get_path('include')})\n"
    assert generators["rosidl_typesupport_c"].read_text().startswith("ament_register_extension(")
    assert generators["rosidl_typesupport_cpp"].read_text().startswith("set(_not_generated")


def test_installed_scripts_start_below_a_blank(tmp_path):
    folder = tmp_path / "a checkout"
    script = folder / "install" / "package" / "lib" / "package" / "node"
    script.parent.mkdir(parents=True)
    python = folder / "python"
    python.symlink_to(PYTHON)
    script.write_text(f'#!"{python}"\nimport sys\nprint(sys.argv[1:])\n')
    script.chmod(0o755)
    for _ in range(2):  # once more does no harm
        subprocess.run(
            ["bash", str(ROOT / "wheels" / "repair_scripts.sh"), str(folder / "install")],
            check=True,
        )
    done = subprocess.run([str(script), "a b"], capture_output=True, text=True, check=True)
    assert done.stdout == "['a b']\n"
