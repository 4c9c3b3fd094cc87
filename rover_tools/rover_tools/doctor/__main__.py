"""The checks that need Python alone: `python -m rover_tools.doctor`, called by ./rover doctor."""

from __future__ import annotations

import os
import sys
from pathlib import Path

from rover_tools.doctor import environment, machine
from rover_tools.doctor.finding import Finding, Level


def findings(folder: Path) -> list[Finding]:
    """folder: where results are written."""
    variables = os.environ
    return [
        environment.check_domain(variables),
        environment.check_discovery(variables),
        environment.check_other_ros(variables),
        environment.check_python_path(variables),
        machine.check_port(),
        machine.check_shared_memory(),
        machine.check_disk(folder),
        machine.check_loopback(),
    ]


def report(found: list[Finding]) -> int:
    """Print a line for each; returns the exit code."""
    for finding in found:
        print(finding.line())
    return int(any(finding.level is Level.WRONG for finding in found))


if __name__ == "__main__":
    sys.exit(report(findings(Path(sys.argv[1]))))
