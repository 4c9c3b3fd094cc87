"""The memory of a large array goes back to the system, whatever was in use before."""

import importlib
import os
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


def grown(given: str) -> int:
    """[bytes] by which the probe has grown."""
    command = [sys.executable, "-c", PROBE, given]
    # Dask leaves limits of its own in the environment of who starts a cluster.
    clean = {name: value for name, value in os.environ.items() if not name.startswith("MALLOC_")}
    done = subprocess.run(command, env=clean, check=True, capture_output=True, text=True)
    return int(done.stdout)


@pytest.mark.skipif(sys.platform != "linux", reason="of glibc")
def test_a_large_array_leaves_nothing_in_the_heap():
    assert grown("set") < MAP / 2 < grown("as it is")


@pytest.mark.parametrize(
    "package", ["rover_decision", "rover_heat", "rover_navigation", "rover_perception"]
)
def test_the_nodes_that_keep_maps_ask_for_it(monkeypatch, package):
    node, asked = importlib.import_module(f"{package}.node"), []
    monkeypatch.setattr(node, "run_node", lambda _, **options: asked.append(options))
    node.main()
    assert asked == [{"keeps_maps": True}]
