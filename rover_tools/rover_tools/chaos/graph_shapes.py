"""Messages on the graph's topics that no node of ours sends, by name.

Each can be recognised as no good by itself. A wrong message that looks right, such as another pose
or another run, is beyond what a node can know: ROS 2 has no authentication here.
"""

from __future__ import annotations

from enum import StrEnum


class GraphShape(StrEnum):
    """What is published; node_graph_faults.py makes the messages."""

    EMPTY_SCAN = "empty scan"
    SCAN_OF_NAN = "scan of NaN"
    GRID_WITHOUT_CELLS = "grid without cells"
    GRID_OF_ANOTHER_SIZE = "grid of another size"
    ZERO_QUATERNION = "zero quaternion"
    NO_PIXELS = "picture without pixels"
    UNEQUAL_ARRAYS = "unequal arrays"
    ROCK_AT_NAN = "rock at NaN"
    CLOCK_AT_ZERO = "clock at zero"
    CLOCK_FAR_AHEAD = "clock far ahead"
    COMMAND_OF_NAN = "command of NaN"


GRAPH_SHAPES = tuple(shape.value for shape in GraphShape)
