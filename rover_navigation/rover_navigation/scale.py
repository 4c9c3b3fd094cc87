"""What has the size of one robot, its sensors or its world: handed to everything that plans.

The values of a robot stand once, with its mission; nothing else in this package holds a size.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Scale:
    """All distances from base_link's origin, in the map frame, unless said otherwise."""

    # Body and sensors, on the costmap
    padding: float  # [m] from obstacles, of every cell that may be driven
    roadmap_cells: int  # cells of the map per cell of the roadmap, in both directions: 1 or 2
    blind_radius: float  # [m] around the robot where its sensors cannot see: free when unknown
    trail_radius: float  # [m] around where the robot has been: free when unknown
    under_body_radius: float  # [m] the same, free whatever the map says
    # [m] Unknown ground this near to an obstacle is kept away from like one: mostly it is the far
    # side of the obstacle, or the wall around the corner.
    hidden_side: float

    # Speeds by clearance, for travel times: between crawling and cruising
    travel_speed_per_clearance: float  # [1/s]
    travel_speed_min: float  # [m/s]
    travel_speed_max: float  # [m/s]
    turn_rate: float  # [rad/s] in place
    turn_seconds: float  # [s] to stop for a turn in place, and to gather speed again

    # Frontiers
    frontier_length: float  # [m] of the shortest border that may be a passage
    strip_depth: float  # [m] of ground between the base of a wall as seen from afar and the wall
    frontier_reach: float  # [m] from where a frontier can be observed
    unknown_depth: float  # [m] of ground guessed behind each metre of a frontier
    body_reach: float  # [m] to the nearest drivable cell, from where the robot or its home is
    wide_reach: float  # [m] to a place with clearance on all sides; else a narrow one does
    seconds_per_area: float  # [s/m^2] of detour that hidden ground is worth
    stop_seconds: float  # [s] to brake, turn and gather speed, which travel times do not count

    # Unsearched cells
    target_reach: float  # [m] from the end of the path, where the approach by sight takes over
    search_distances: tuple[float, ...]  # [m] from how near a cell must have been observed, in turn
    search_range: float  # [m] a target beyond is rarely seen
    search_field: float  # [rad] of view, to either side
    search_slack: float  # [m] of a cell that may lie beyond the end of the free ground
    search_cell: float  # [m]
    # [m] A cell with free ground this near to its middle, on any side, is the base of a wall. It
    # counts as observed only when the view reached it and no other wall was in between.
    base_reach: float

    # Goals
    same_goal: float  # [m] a goal this near to the last one is the same, seen anew
    goal_reached: float  # [m] from where a goal is observed
    goal_field: float  # [rad] to either side: a goal further aside is not observed
    goal_underfoot: float  # [m] nearer than this a goal need not be faced
    goal_radius_min: float  # [m] of the disc that an observation without result settles
    goal_radius_per_distance: float  # of that disc: the wider the farther off
    goal_afar: float  # [m] a goal observed from farther off may still be a passage

    # Paths
    path_clearance: float  # [m] wanted beside a path
    smoothing_min: float  # [m] deviation of the Gaussian over a path
    smoothing_max: float  # [m]
    path_speed_per_clearance: float  # [1/s] of a path's speed limit
    path_speed_min: float  # [m/s] limit in the narrowest place

    # Path tracking
    lookahead_min: float  # [m]
    lookahead_max: float  # [m]
    horizon: float  # [m] of the path that decides on the speed
    path_end: float  # [m] from a path's last point that counts as there
    stop_margin: float  # [m] between an obstacle and where the robot would stop

    # Progress and recovery
    progress_distance: float  # [m] that counts as progress
    stall_distance: float  # [m] within which the robot does not move at all
    clear_distance: float  # [m] from where it got stuck: the trouble is over
    back_distance: float  # [m] to back at least, from where it tilted
    safe_pose_reached: float  # [m]
    safe_pose_spacing: float  # [m]
    blocked_ahead: float  # [m] of a blocked place, from where the robot got stuck
    blocked_radius: float  # [m]
    same_stop: float  # [m] within which stops are at the same place

    # Breadcrumbs
    breadcrumb_spacing: float  # [m]
    breadcrumb_link: float  # [m] breadcrumbs this near to each other are linked in any case
    breadcrumb_shortcut: float  # [m] and up to here where the map shows free ground in between
    shortcut_clearance: float  # [m] from obstacles, of such a shortcut

    @property
    def inflation(self) -> float:
        """[m] from obstacles, beyond which more clearance makes the robot no faster."""
        return self.travel_speed_max / self.travel_speed_per_clearance

    @property
    def clearance_limit(self) -> float:
        """[m] from obstacles, beyond which more clearance changes neither times nor paths."""
        return max(self.inflation, self.path_clearance + self.smoothing_max)
