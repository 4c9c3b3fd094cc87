"""What a thermal sensor may send, and what is made of it."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from rover_heat.config import FLIPS
from rover_heat.thermal.validation import ThermalFrameError, valid_celsius

FRAME = np.arange(64.0).reshape(8, 8) / 4.0 + 20.0


@pytest.mark.parametrize("shape", [(64,), (8, 8), (1, 64), (4, 16)])
def test_64_values_are_a_frame_in_any_shape(shape):
    assert np.array_equal(valid_celsius(FRAME.reshape(shape).astype(np.float32), "none"), FRAME)


@pytest.mark.parametrize("count", [0, 1, 63, 65, 128])
def test_any_other_number_of_values_is_refused(count):
    with pytest.raises(ThermalFrameError, match=f"{count} values"):
        valid_celsius(np.full(count, 22.0), "none")


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, -20.5, 120.5, 300.0, 480.0])
def test_a_value_that_cannot_be_is_refused(value):
    frame = FRAME.copy()
    frame[3, 4] = value
    with pytest.raises(ThermalFrameError):
        valid_celsius(frame, "none")


@pytest.mark.parametrize("value", [-0.25, -5.0, -19.75])
def test_a_small_negative_that_was_read_without_its_sign_is_repaired(value):
    frame = FRAME.copy()
    frame[0, 0] = value + 512.0
    assert valid_celsius(frame, "none")[0, 0] == value


@pytest.mark.parametrize("flip", FLIPS)
def test_a_mirrored_sensor_is_put_upright(flip):
    mounted = FRAME
    if flip in ("rows", "both"):
        mounted = np.flipud(mounted)
    if flip in ("columns", "both"):
        mounted = np.fliplr(mounted)
    assert np.array_equal(valid_celsius(mounted, flip), FRAME)


@given(st.lists(st.floats(width=32), max_size=70))
def test_whatever_comes_is_a_frame_or_an_error(values):
    try:
        frame = valid_celsius(values, "both")
    except ThermalFrameError:
        return
    assert frame.shape == (8, 8)
    assert frame.min() >= -20.0
    assert frame.max() <= 120.0
