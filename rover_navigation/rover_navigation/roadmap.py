"""Travel times over the map: a graph of drivable cells, and shortest paths through it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse.csgraph import dijkstra

from rover_common.grid import GridGeometry
from rover_navigation.costmap import Costmap
from rover_navigation.grid_graph import graph_of_steps, node_numbers, path_nodes, step_costs
from rover_navigation.local_searches import LocalSearches
from rover_navigation.scale import Scale

ROUNDING = 1e-6  # [s] of sums in another order


@dataclass(frozen=True)
class ShortestPaths:
    """From some nodes to all others."""

    seconds: NDArray[np.float64]  # (sources, nodes), inf where there is no path
    predecessors: NDArray[np.int32]  # (sources, nodes)


class TravelLayers(NamedTuple):
    """Cells as coarse as the scale says: what of them depends on their surroundings alone."""

    drivable: NDArray[np.bool_]  # (rows, cols)
    wide: NDArray[np.bool_]  # (rows, cols) with clearance on all sides
    steps: NDArray[np.float32]  # (rows, cols, 8) [s] to each neighbour, inf where that is closed

    @classmethod
    def of(cls, costmap: Costmap, scale: Scale) -> TravelLayers:
        cells = scale.roadmap_cells
        clearance = np.minimum.reduce(_parts(costmap.clearance, cells))
        edge_clearance = np.minimum.reduce(_parts(costmap.edge_clearance, cells))
        free = np.logical_and.reduce(_parts(costmap.free, cells))
        drivable = free & (clearance >= scale.padding)
        speed = scale.travel_speed_per_clearance * edge_clearance
        pace = 1.0 / np.clip(speed, scale.travel_speed_min, scale.travel_speed_max)  # [s/m]
        steps = step_costs(drivable, pace, costmap.geometry.resolution * cells)
        return cls(drivable, drivable & (edge_clearance >= scale.padding), steps)

    def part(self, cells: tuple[slice, slice]) -> TravelLayers:
        """Some of the cells, as views."""
        return TravelLayers(self.drivable[cells], self.wide[cells], self.steps[cells])


class Roadmap:
    """Nodes are drivable cells of a grid as coarse as the scale says.

    `drivable` and `wide` (rows, cols): the cells that are nodes, and those with clearance on all
    sides; `numbers` (rows, cols): the node of each cell, -1 where there is none; `x` and `y`
    (nodes,) [m].
    """

    def __init__(
        self,
        costmap: Costmap,
        scale: Scale,
        layers: TravelLayers | None = None,
        searches: LocalSearches | None = None,
    ) -> None:
        """layers: those of the costmap, where they are known; searches: of the plan before."""
        fine, cells = costmap.geometry, scale.roadmap_cells
        self.geometry = GridGeometry(
            fine.resolution * cells,
            fine.rows // cells,
            fine.cols // cells,
            fine.origin_x,
            fine.origin_y,
        )
        layers = layers or TravelLayers.of(costmap, scale)
        self.drivable, self.wide = layers.drivable, layers.wide
        self.numbers = node_numbers(self.drivable)
        self._cells = np.flatnonzero(self.drivable)
        rows, cols = np.divmod(self._cells, self.geometry.cols)
        self.x, self.y = self.geometry.center_of(rows, cols)
        self._graph = graph_of_steps(self.numbers, layers.steps)
        self._searches = searches or LocalSearches()

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

    def seconds_between(self, paths: ShortestPaths, nodes: list[int]) -> NDArray[np.float64]:
        """Travel times (n, n) between nodes that are reached from the paths' first source.

        Along those paths it takes no longer than to where they part and back. So each search goes
        half as far and meets those of the others there: what it costs depends on how far the nodes
        are from each other, and not on the map.
        """
        half = 0.5 * self._seconds_along(paths, nodes).max(axis=1) + self._longest_step + ROUNDING
        return self._searches.seconds_between(
            self._graph,
            self.numbers.ravel(),
            self._cells,
            nodes,
            half,
            paths.seconds[0, nodes],
        )

    def _seconds_along(self, paths: ShortestPaths, nodes: list[int]) -> NDArray[np.float64]:
        """(n, n) [s] from node to node along the paths' tree, by where the paths part."""
        routes = [path_nodes(paths.predecessors[0], node) for node in nodes]
        steps = np.empty((len(nodes), max(map(len, routes)) + 1), np.intp)
        for number, route in enumerate(routes):
            steps[number] = -1 - number  # beyond its end every route differs from all others
            steps[number, : len(route)] = route
        parted = (steps[:, None] != steps).argmax(axis=2)  # the first step that differs
        np.fill_diagonal(parted, 1)  # where none does
        seconds = paths.seconds[0]
        fork = seconds[steps[np.arange(len(nodes))[:, None], parted - 1]]
        along = seconds[nodes][:, None] + seconds[nodes] - 2.0 * fork
        np.fill_diagonal(along, 0.0)
        return np.asarray(along)

    @cached_property
    def _longest_step(self) -> float:
        return float(self._graph.data.max(initial=0.0))

    def path(self, paths: ShortestPaths, source: int, target: int) -> NDArray[np.float64]:
        """Points (n, 2) [m] from source number `source` of the paths to a node, cell by cell."""
        nodes = path_nodes(paths.predecessors[source], target)
        return np.stack([self.x[nodes], self.y[nodes]], axis=1)


def _parts(values: NDArray, cells: int) -> list[NDArray]:
    """Of each cell of the graph the first of its `cells` x `cells`, the second, and so on.

    To reduce these costs a fortieth of what `reshape` and a reduction over two short axes cost.
    """
    return [values[row::cells, col::cells] for row in range(cells) for col in range(cells)]
