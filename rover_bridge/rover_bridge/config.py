"""Parameters of the bridge node."""

from __future__ import annotations

from dataclasses import dataclass

from rover_common.config import parameter


@dataclass(frozen=True)
class BridgeConfig:
    """Read at the start of the node."""

    host: str = parameter("127.0.0.1", "address to listen on; 0.0.0.0 for other machines too")
    port: int = parameter(
        4567, "TCP port, 0 for any free one; the simulator wants 4567", minimum=0, maximum=65535
    )
    answer_deadline: float = parameter(
        0.5,
        "[s] of wall time after which a telemetry without a decision is answered with the brake",
        minimum=0.01,
        maximum=60.0,
    )
    insets: str = parameter(
        "auto",
        "when answers carry pictures for the simulator's screen: always, never, or auto: for a "
        "client that shows them",
        choices=("auto", "always", "never"),
    )
    inset_period: float = parameter(
        0.5, "[s] of wall time between two pairs of insets", minimum=0.05, maximum=60.0
    )
    truth: str = parameter(
        "", "picture of the true map, for the colours of the map's inset; empty for none"
    )
