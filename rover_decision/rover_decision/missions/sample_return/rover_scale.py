"""The rover's sizes, as the planner needs them. Cells of its navigation map have 0.25 m."""

import math

from rover_common.vehicle import ROVER
from rover_navigation.scale import Scale

ROVER_SCALE = Scale(
    padding=0.55,  # half the rover's width, and what a wheel may stray
    roadmap_cells=2,
    blind_radius=ROVER.camera_blind_radius,
    trail_radius=0.5,
    under_body_radius=0.25,  # no more, because its wheels pass rocks 0.44 m aside
    hidden_side=1.0,
    travel_speed_per_clearance=1.5,
    travel_speed_min=0.5,
    travel_speed_max=2.5,
    turn_rate=ROVER.turn_in_place_rate * ROVER.max_steering,
    turn_seconds=2.0,
    frontier_length=2.5,
    strip_depth=0.75,
    frontier_reach=10.0,
    unknown_depth=8.0,
    body_reach=3.0,
    wide_reach=4.0,
    seconds_per_area=1.5,  # a canyon's ground takes about a quarter of it
    stop_seconds=3.0,
    target_reach=2.5,
    # A rock in the open shows from the first on in every observation, one half buried or behind the
    # swell of a wall's base from the second on.
    search_distances=(5.0, 3.0),
    search_range=6.0,
    search_field=math.radians(45.0),
    search_slack=0.7,
    search_cell=1.0,
    base_reach=0.6,
    same_goal=4.0,
    goal_reached=1.2,
    goal_field=math.radians(40.0),  # the camera sees 54 degrees to either side
    goal_underfoot=1.0,  # the camera sees no ground nearer than this, in any direction
    goal_radius_min=1.5,
    goal_radius_per_distance=0.4,
    goal_afar=4.0,
    path_clearance=0.5,
    smoothing_min=0.5,
    smoothing_max=2.5,
    path_speed_per_clearance=2.2,
    path_speed_min=0.8,
    lookahead_min=1.2,
    lookahead_max=3.0,
    horizon=15.0,
    path_end=1.0,
    stop_margin=0.8,
    progress_distance=0.5,
    stall_distance=0.05,
    clear_distance=2.0,
    back_distance=0.7,
    safe_pose_reached=0.4,
    safe_pose_spacing=0.2,
    blocked_ahead=1.0,
    blocked_radius=0.5,
    same_stop=1.0,
    breadcrumb_spacing=0.5,
    breadcrumb_link=1.0,
    breadcrumb_shortcut=6.0,
    shortcut_clearance=0.6,
)
