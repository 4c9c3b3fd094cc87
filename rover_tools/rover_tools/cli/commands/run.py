"""`rover run PACKAGE EXECUTABLE`."""

from __future__ import annotations

import os
from pathlib import Path

import click

from rover_common.errors import RoverError


class NoExecutableError(RoverError):
    """There is no such package or executable."""


@click.command(
    "run", context_settings={"ignore_unknown_options": True, "allow_interspersed_args": False}
)
@click.argument("package")
@click.argument("executable")
@click.argument("arguments", nargs=-1, type=click.UNPROCESSED, metavar="[ARGUMENTS]...")
def command(package: str, executable: str, arguments: tuple[str, ...]) -> None:
    """Run an executable of a package, as `ros2 run` does, without the ros2 command.

    \b
    Examples:
      ./rover run rover_bridge bridge_node
      ./rover run rover_bridge bridge_node --ros-args -p port:=4568
    """
    path = str(find_executable(package, executable))
    os.execv(path, [path, *arguments])


def find_executable(package: str, executable: str) -> Path:
    """Raises NoExecutableError, which says what there is."""
    from ament_index_python.packages import PackageNotFoundError, get_package_prefix

    try:
        folder = Path(get_package_prefix(package)) / "lib" / package
    except (PackageNotFoundError, ValueError):
        raise NoExecutableError(f"no package '{package}'") from None
    path = folder / executable
    if not (path.is_file() and os.access(path, os.X_OK)):
        there = ", ".join(sorted(file.name for file in folder.glob("*"))) or "none"
        raise NoExecutableError(
            f"package '{package}' has no executable '{executable}'; there is {there}"
        )
    return path
