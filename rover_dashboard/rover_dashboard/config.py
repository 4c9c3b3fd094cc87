"""Parameters of the dashboard node."""

from __future__ import annotations

from dataclasses import dataclass

from rover_common.config import parameter


@dataclass(frozen=True)
class DashboardConfig:
    host: str = parameter("127.0.0.1", "address to listen on; 0.0.0.0 for other machines too")
    port: int = parameter(
        8080, "TCP port of the page, 0 for any free one", minimum=0, maximum=65535
    )
