"""The simulator's camera: an ideal pinhole, fixed to the body, looking straight ahead."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

# Height of base_link's origin above flat ground when the rover stands [m]: the wheels' suspension
# carries it there. Telemetry has no height, so this is the height wherever one is needed.
ORIGIN_HEIGHT = -0.0115


@dataclass(frozen=True)
class PinholeCamera:
    """Intrinsics and mounting; pixel (u, v) has its centre at (u + 0.5, v + 0.5)."""

    width: int  # [px]
    height: int  # [px]
    focal: float  # [px], the same in both directions
    center_u: float  # [px] in coordinates where the left edge of the image is 0
    center_v: float  # [px]
    forward: float  # [m] of the optical centre in base_link
    up: float  # [m] of the optical centre in base_link

    def rays(self) -> NDArray[np.float32]:
        """Viewing rays (height, width, 3) in base_link axes, with forward component 1."""
        u = np.arange(self.width, dtype=np.float32) + 0.5
        v = np.arange(self.height, dtype=np.float32) + 0.5
        rays = np.ones((self.height, self.width, 3), np.float32)
        rays[..., 1] = (self.center_u - u)[None, :] / self.focal
        rays[..., 2] = (self.center_v - v)[:, None] / self.focal
        return rays


# 70 degrees of vertical field of view over 160 rows: focal = 80 / tan(35 degrees).
ROVER_CAMERA = PinholeCamera(
    width=320,
    height=160,
    focal=114.25184,
    center_u=160.0,
    center_v=80.0,
    forward=0.4287,
    up=0.2391,
)
