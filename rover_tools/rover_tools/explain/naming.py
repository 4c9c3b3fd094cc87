"""What functions are called in the code."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any


def name_of(function: Callable[..., Any]) -> str:
    """Where to find a function or a class: its module and its name there."""
    return f"{function.__module__}.{function.__qualname__}"
