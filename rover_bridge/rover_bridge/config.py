"""Parameters of the bridge node."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from rover_bridge.access import Access
from rover_bridge.transport import WireLimits
from rover_common.config import STATE_DIR, parameter
from rover_common.frames import CAMERA, CAMERA_OPTICAL, FrameConfig, Frames
from rover_common.ground_truth import load_truth


@dataclass(frozen=True)
class BridgeConfig:
    """Read at the start of the node, but what is settable."""

    host: str = parameter("127.0.0.1", "address to listen on; 0.0.0.0 for other machines too")
    port: int = parameter(
        4567, "TCP port, 0 for any free one; the simulator wants 4567", minimum=0, maximum=65535
    )
    allowed_origins: str = parameter(
        "",
        "origins of pages that may connect, separated by spaces, such as http://robot:8000; the "
        "bridge's own address is always one",
    )
    token: str = parameter(
        "", "what clients have to send as token=... in the query of their URL; empty for none"
    )
    max_connections: int = parameter(
        64, "connections that may be open at a time", minimum=2, maximum=900
    )
    client_rate: float = parameter(
        400.0,
        "[1/s] messages of one client that are read; a client that sends more has to wait",
        minimum=10.0,
        maximum=10000.0,
    )
    idle_limit: float = parameter(
        60.0,
        "[s] without a message, after which a connection is closed; the simulator pings after 25",
        minimum=1.0,
        maximum=86400.0,
    )
    answer_deadline: float = parameter(
        0.25,
        "[s] of wall time after which a telemetry without a decision is answered with the brake",
        minimum=0.01,
        maximum=60.0,
    )
    enable_stamped_cmd_vel: bool = parameter(
        False, "whether velocities are TwistStamped, as the parameter of this name of Nav2 says"
    )
    insets: str = parameter(
        "auto",
        "when answers carry pictures for the simulator's screen: always, never, or auto: for a "
        "client that shows them",
        choices=("auto", "always", "never"),
        settable=True,
    )
    inset_period: float = parameter(
        0.5,
        "[s] of wall time between two pairs of insets",
        minimum=0.05,
        maximum=60.0,
        settable=True,
    )
    camera_transforms: bool = parameter(
        True, "send the transforms to the camera's frames; not where robot_state_publisher does"
    )
    truth: str = parameter(
        "", "picture of the true map, for the colours of the map's inset; empty for none"
    )
    state_dir: str = parameter(*STATE_DIR)

    def limits(self) -> WireLimits:
        """Those of the transport."""
        return WireLimits(self.max_connections, self.client_rate, self.idle_limit)

    def true_map(self) -> NDArray[np.bool_] | None:
        """Raises TruthError."""
        return load_truth(Path(self.truth)) if self.truth else None

    def access(self) -> Access:
        """Raises AccessError."""
        return Access(self.allowed_origins, self.token)


@dataclass(frozen=True)
class CameraFrameConfig(FrameConfig):
    """The frames of the rover with its camera."""

    camera_frame: str = parameter(CAMERA, "frame of the camera, x forward")
    camera_optical_frame: str = parameter(CAMERA_OPTICAL, "frame of its images, z forward")

    def frames(self) -> Frames:
        """Raises FrameIdError."""
        own = Frames(
            map=self.map_frame,
            odom=self.odom_frame,
            base=self.base_frame,
            camera=self.camera_frame,
            camera_optical=self.camera_optical_frame,
        )
        return own.prefixed(self.frame_prefix)
