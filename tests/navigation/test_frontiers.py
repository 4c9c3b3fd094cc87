"""Frontiers: which ground may lie behind them."""

import pytest
from maps import HALL, NO_DISCS, OPEN_EAST, SCALE, costmap, opened

from rover_navigation.frontiers import find_frontiers


def test_an_unknown_patch_amid_known_ground_is_worth_what_it_can_hide():
    def worth(size: float) -> float:
        patch = costmap(opened(HALL, 30, 18, 30 + size, 18 + size))
        frontiers = find_frontiers(patch, NO_DISCS, SCALE)
        return sum(frontier.hidden_area(SCALE) for frontier in frontiers)

    assert worth(2.0) == pytest.approx(0.5 * 2.0**2)
    assert worth(4.0) == pytest.approx(0.5 * 4.0**2)


def test_unknown_ground_without_an_end_is_unbounded():
    (frontier,) = find_frontiers(costmap(OPEN_EAST), NO_DISCS, SCALE)
    assert frontier.hidden_area(SCALE) == float("inf")
