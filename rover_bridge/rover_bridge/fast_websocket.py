"""The WebSocket of python-engineio for eventlet, with the unmasking done by numpy.

The library unmasks byte by byte in Python, which costs milliseconds for a message of 10 kB.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from typing import Any

import numpy as np
from engineio.async_drivers.eventlet import WebSocketWSGI


def apply_mask(
    data: bytes, mask: Sequence[int], length: int | None = None, offset: int = 0
) -> bytes:
    """XOR with the four bytes of the mask, repeated, beginning at `offset` (RFC 6455, 5.3)."""
    payload = np.frombuffer(data, np.uint8, count=len(data) if length is None else length)
    key = np.roll(np.array(mask, np.uint8), -(offset % 4))
    return (payload ^ np.resize(key, payload.size)).tobytes()


class FastWebSocketWSGI(WebSocketWSGI):
    """Opens WebSockets that unmask with numpy."""

    def _handle_hybi_request(self, environ: dict[str, Any]) -> Any:
        websocket = super()._handle_hybi_request(environ)
        websocket._apply_mask = apply_mask
        websocket.log = io.StringIO()  # it reports that it closes twice
        return websocket
