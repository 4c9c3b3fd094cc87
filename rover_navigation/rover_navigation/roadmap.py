"""Travel times over the map: a graph of drivable cells, and shortest paths through it."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.csgraph import dijkstra

from rover_common.grid import GridGeometry
from rover_navigation.costmap import Costmap
from rover_navigation.grid_graph import grid_graph, node_numbers, path_nodes
from rover_navigation.scale import Scale

ROUNDING = 1e-6  # [s] of sums in another order


@dataclass(frozen=True)
class ShortestPaths:
    """From some nodes to all others."""

    seconds: NDArray[np.float64]  # (sources, nodes), inf where there is no path
    predecessors: NDArray[np.int32]  # (sources, nodes)


class Roadmap:
    """Nodes are drivable cells of a grid as coarse as the scale says.

    `drivable` and `wide` (rows, cols): the cells that are nodes, and those with clearance on all
    sides; `numbers` (rows, cols): the node of each cell, -1 where there is none; `x` and `y`
    (nodes,) [m].
    """

    def __init__(self, costmap: Costmap, scale: Scale) -> None:
        fine, cells = costmap.geometry, scale.roadmap_cells
        self.geometry = GridGeometry(
            fine.resolution * cells,
            fine.rows // cells,
            fine.cols // cells,
            fine.origin_x,
            fine.origin_y,
        )
        clearance = np.minimum.reduce(_parts(costmap.clearance, cells))
        edge_clearance = np.minimum.reduce(_parts(costmap.edge_clearance, cells))
        free = np.logical_and.reduce(_parts(costmap.free, cells))
        self.drivable = free & (clearance >= scale.padding)
        self.wide = self.drivable & (edge_clearance >= scale.padding)
        speed = scale.travel_speed_per_clearance * edge_clearance
        pace = 1.0 / np.clip(speed, scale.travel_speed_min, scale.travel_speed_max)  # [s/m]
        self.numbers = node_numbers(self.drivable)
        rows, cols = np.nonzero(self.drivable)
        self.x, self.y = self.geometry.center_of(rows, cols)
        self._graph = grid_graph(self.drivable, pace, self.geometry.resolution)

    def __len__(self) -> int:
        return len(self.x)

    def shortest_paths(self, sources: list[int]) -> ShortestPaths:
        """From each of the nodes."""
        seconds, predecessors = dijkstra(
            self._graph, indices=sources, return_predecessors=True, directed=True
        )
        return ShortestPaths(seconds, predecessors)

    def seconds_from(self, sources: list[int], limit: float = np.inf) -> NDArray[np.float64]:
        """Travel times (sources, nodes) alone; inf beyond the limit [s]."""
        return np.asarray(dijkstra(self._graph, indices=sources, directed=True, limit=limit))

    def seconds_between(
        self, nodes: list[int], from_here: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Travel times (n, n) between nodes that are reached from here, in so many seconds (n,).

        From one to another it takes no longer than by here, so the search goes no farther: what it
        costs depends on how far the nodes are, and not on the map.
        """
        farthest = float(from_here.max())
        return np.concatenate(
            [
                self.seconds_from([node], float(seconds) + farthest + ROUNDING)[:, nodes]
                for node, seconds in zip(nodes, from_here, strict=True)
            ]
        )

    def path(self, paths: ShortestPaths, source: int, target: int) -> NDArray[np.float64]:
        """Points (n, 2) [m] from source number `source` of the paths to a node, cell by cell."""
        nodes = path_nodes(paths.predecessors[source], target)
        return np.stack([self.x[nodes], self.y[nodes]], axis=1)


def _parts(values: NDArray, cells: int) -> list[NDArray]:
    """Of each cell of the graph the first of its `cells` x `cells`, the second, and so on.

    To reduce these costs a fortieth of what `reshape` and a reduction over two short axes cost.
    """
    return [values[row::cells, col::cells] for row in range(cells) for col in range(cells)]
