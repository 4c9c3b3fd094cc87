"""The memory of a large array goes back to the system, whatever was in use before."""

import subprocess
import sys

import pytest

PROBE = """
import numpy as np, psutil, sys
from rover_common.ros.memory import return_large_arrays
if sys.argv[1] == "set":
    return_large_arrays()
size = 800 * 800
np.ones(size)  # and from here on glibc has none of this size mapped
memory = psutil.Process().memory_info
before = memory().rss
kept = []
for _ in range(10):
    large = np.ones(size)
    kept.append(np.ones(5000))  # stays, behind it
    more = np.ones(size)
    kept.append(np.ones(5000))
    del large, more
print(memory().rss - before)
"""
MAP = 8 * 800 * 800  # [bytes]


@pytest.mark.skipif(sys.platform != "linux", reason="of glibc")
def test_a_large_array_leaves_nothing_in_the_heap():
    grown = {
        given: int(
            subprocess.run(
                [sys.executable, "-c", PROBE, given], check=True, capture_output=True, text=True
            ).stdout
        )
        for given in ("set", "as it is")
    }
    assert grown["set"] < MAP / 2 < grown["as it is"]
