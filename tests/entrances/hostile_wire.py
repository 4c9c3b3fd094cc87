"""Telemetries as no simulator sends them."""

from __future__ import annotations

import base64
import math
from typing import Any

from hypothesis import strategies as st
from telemetry import IMAGE, telemetry

NUMBERS = (
    "", " ", "nan", "inf", "-inf", "1e400", "-0", "1,5", "1.5", "1;5", "1.000,5", "0x1f", "1_0",
    "٣", "9" * 400, "--1", "1e-400", "\x00", "true", "None", "6.5;7.5;8.5", ";;;",
)  # fmt: skip
VALUES = st.one_of(
    st.sampled_from(NUMBERS),
    st.sampled_from([None, True, False, 0, 1, -1, 2**70, 1.5, math.nan, math.inf, [], {}, [1, 2]]),
    st.floats(-1e4, 1e4).map(lambda value: f"{value:.4f}"),
    st.text(max_size=20),
)
JSON = st.recursive(
    st.one_of(st.none(), st.booleans(), st.integers(), st.floats(), st.text(max_size=10)),
    lambda inner: st.one_of(
        st.lists(inner, max_size=4), st.dictionaries(st.text(max_size=5), inner, max_size=4)
    ),
    max_leaves=10,
)


@st.composite
def changed_bytes(draw: Any, data: bytes) -> bytes:
    """Some of it cut out, put in, repeated, or other."""
    for _ in range(draw(st.integers(0, 3))):
        at = draw(st.integers(0, max(0, len(data) - 1)))
        to = at + draw(st.sampled_from([0, 1, 2, 8, 100, len(data)]))
        new = draw(st.one_of(st.binary(max_size=8), st.just(data[at:to] * 2), st.just(b"")))
        data = data[:at] + new + data[to:]
    return data


@st.composite
def telemetries(draw: Any) -> dict[str, Any]:
    """A good one with some values changed, left out or added."""
    wire: dict[str, Any] = dict(telemetry())
    for _ in range(draw(st.integers(0, 3))):
        key = draw(st.sampled_from([*sorted(telemetry()), "sim_time", "shows_insets", "other"]))
        match draw(st.integers(0, 9)):
            case 0:
                wire.pop(key, None)
            case 1 | 2:
                data = draw(changed_bytes(IMAGE))
                wire["image"] = base64.b64encode(data).decode()
            case _:
                wire[key] = draw(VALUES)
    return wire


PAYLOADS = st.one_of(telemetries(), telemetries(), telemetries(), JSON)
