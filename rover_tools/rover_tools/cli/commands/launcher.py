"""The checkout that this package is a part of, for what only its launcher can do."""

from __future__ import annotations

import os
from pathlib import Path
from typing import NoReturn

from rover_common.errors import RoverError

ROOT = Path(__file__).resolve().parents[4]


class NoCheckoutError(RoverError):
    """The package is installed without the checkout that it came from."""


def checkout() -> Path:
    """The folder of ./rover; raises NoCheckoutError."""
    if not (ROOT / "rover").is_file():
        raise NoCheckoutError("this needs a checkout, whose ./rover is not here; call it there")
    return ROOT


def call_launcher(command: str) -> NoReturn:
    """Become ./rover COMMAND; raises NoCheckoutError."""
    launcher = str(checkout() / "rover")
    os.execv(launcher, [launcher, command])
