"""Keep a process that runs for hours as small as what it holds."""

from __future__ import annotations

import ctypes
from contextlib import suppress

# Of mallopt(3), in glibc.
TRIM_THRESHOLD, MMAP_THRESHOLD = -1, -3
LARGE = 1 << 19  # [bytes] less than a navigation map; most arrays of a frame are smaller
SPARE = 8 << 20  # [bytes] at the heap's end that need not be asked for again, frame after frame


def return_large_arrays() -> None:
    """Let the memory of each large array go back to the system when the array ends.

    By itself glibc puts all arrays into its heap that are no larger than the largest one that has
    ended; small things that stay between them leave holes there that no map fits into, more of
    them with each mission. It is not for who makes pictures: to get each array from the system
    anew costs the simulator a seventh of its time. Other C libraries are left as they are.
    """
    with suppress(OSError, AttributeError, TypeError):
        mallopt = ctypes.CDLL(None).mallopt
        mallopt(MMAP_THRESHOLD, LARGE)
        mallopt(TRIM_THRESHOLD, SPARE)
