"""In nodes that keep maps the memory of a large array goes back to the system."""

import importlib
import subprocess
import sys

import pytest

PROBE = """
import numpy as np, psutil
from rover_common.ros.memory import return_large_arrays
return_large_arrays()
size = 800 * 800
np.ones(size)  # from here on glibc by itself has none of this size mapped
large, behind = np.ones(size), np.ones(5000)
memory = psutil.Process().memory_info
before = memory().rss
del large
print(before - memory().rss)
"""
MAP = 8 * 800 * 800  # [bytes]


@pytest.mark.skipif(sys.platform != "linux", reason="of glibc")
def test_the_memory_of_a_large_array_goes_back_at_once():
    done = subprocess.run([sys.executable, "-c", PROBE], check=True, capture_output=True, text=True)
    assert int(done.stdout) > 0.9 * MAP


@pytest.mark.parametrize(
    "package", ["rover_decision", "rover_heat", "rover_navigation", "rover_perception"]
)
def test_the_nodes_that_keep_maps_ask_for_it(monkeypatch, package):
    node, asked = importlib.import_module(f"{package}.node"), []
    monkeypatch.setattr(node, "run_node", lambda _, **options: asked.append(options))
    node.main()
    assert asked == [{"keeps_maps": True}]
