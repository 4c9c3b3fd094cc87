"""What the navigator says, as messages; stamps are [ns]."""

from __future__ import annotations

import math

import numpy as np
from builtin_interfaces.msg import Duration
from nav2_msgs.action import NavigateToPose
from nav_msgs.msg import Path
from numpy.typing import NDArray
from rover_interfaces.msg import NavigationTick

from rover_common.frames import FRAMES, Frames
from rover_common.geometry import Pose
from rover_common.ros.check_values import FARTHEST, check_within
from rover_common.ros.conversions import NANOSECONDS, header_of, time_of
from rover_common.ros.message_checks import check_pose
from rover_common.ros.transforms import pose_message_of
from rover_navigation.embedded_goal import EmbeddedGoal
from rover_navigation.embedded_navigator import NavigatorOutput

# A failure of no kind that the action has a number for; the text has the reason.
UNKNOWN_ERROR = 9000


def check_feedback(feedback: NavigateToPose.Feedback) -> None:
    """Raises MessageError."""
    check_pose(feedback.current_pose)
    check_within("distance remaining", feedback.distance_remaining, 0.0, FARTHEST)


def feedback_of(
    output: NavigatorOutput,
    goal: EmbeddedGoal,
    begun: int,
    speed: float,
    frames: Frames = FRAMES,
) -> NavigateToPose.Feedback:
    """begun: [ns] when the goal was accepted; speed: [m/s] that the time left is estimated by.

    Without a path the distance left is 0, as Nav2 has it.
    """
    left = goal.distance_left if math.isfinite(goal.distance_left) else 0.0
    pose = output.pose or Pose(0.0, 0.0, 0.0)
    return NavigateToPose.Feedback(
        current_pose=pose_message_of(output.stamp, frames.map, pose),
        navigation_time=_duration(max(0, output.stamp - begun)),
        estimated_time_remaining=_duration(round(left / speed * NANOSECONDS)),
        number_of_recoveries=goal.recoveries,
        distance_remaining=left,
    )


def result_of(reason: str, failed: bool) -> NavigateToPose.Result:
    """How a goal ended."""
    result = NavigateToPose.Result
    return result(error_code=UNKNOWN_ERROR if failed else result.NONE, error_msg=reason)


def path_of(stamp: int, points: NDArray[np.float64], frames: Frames = FRAMES) -> Path:
    """Points (n, 2) [m] of the map; each pose faces the next one."""
    steps = np.diff(points, axis=0, append=points[-1:])
    yaws = np.arctan2(steps[:, 1], steps[:, 0])
    yaws[-1:] = yaws[-2:-1] if len(yaws) > 1 else 0.0
    poses = [
        pose_message_of(stamp, frames.map, Pose(float(x), float(y), float(yaw)))
        for (x, y), yaw in zip(points, yaws, strict=True)
    ]
    return Path(header=header_of(stamp, frames.map), poses=poses)


def tick_message_of(
    output: NavigatorOutput, hazards: int, frames: Frames = FRAMES
) -> NavigationTick:
    """hazards: stamp of the newest hazard map that was taken."""
    return NavigationTick(
        header=header_of(output.stamp, frames.map),
        transform=output.map_to_odom is not None,
        map=output.map is not None,
        velocity=output.twist is not None,
        hazards=time_of(hazards),
    )


def _duration(nanoseconds: int) -> Duration:
    sec, nanosec = divmod(nanoseconds, NANOSECONDS)
    return Duration(sec=sec, nanosec=nanosec)
