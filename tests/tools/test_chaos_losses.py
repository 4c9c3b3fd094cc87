"""What a mission lost: each loss by its name, once, and nothing where nothing is lost."""

from __future__ import annotations

from dataclasses import replace

import pytest

from rover_tools.chaos.losses import Knowledge, Ledger, Rock, losses_between

ROCKS = (Rock(1, 10.0, 20.0), Rock(4, 30.0, 40.0), Rock(6, 70.0, 40.0))
SEEN = Rock(7, 50.0, 60.0)
BEFORE = Knowledge(
    run=1, elapsed=50.0, samples_total=6, samples_collected=2, home_error=0.1, cells=1000,
    rocks=ROCKS,
)  # fmt: skip
LATER = replace(BEFORE, elapsed=60.0, samples_collected=3, cells=1100, rocks=(*ROCKS, SEEN))


def names(before: Knowledge, after: Knowledge) -> list[str]:
    return [loss.name for loss in losses_between(before, after)]


def test_a_mission_that_goes_on_loses_nothing():
    assert names(BEFORE, LATER) == []
    assert names(BEFORE, BEFORE) == []


@pytest.mark.parametrize(
    ("name", "change"),
    [
        ("run", {"run": 2}),
        ("mission", {"elapsed": 3.0}),
        ("samples", {"samples_collected": 1}),
        ("samples", {"samples_total": 5}),
        ("home", {"home_error": 12.0}),
        ("map", {"cells": 900}),
        ("map", {"cells": 0}),
        ("rocks", {"rocks": ROCKS[:1]}),
        ("rocks", {"rocks": (ROCKS[0], Rock(8, 30.0, 44.0), Rock(9, 74.0, 40.0))}),
        ("rocks", {"rocks": (SEEN, Rock(4, 90.0, 50.0))}),  # another one is number 4 now
    ],
)
def test_each_loss_has_its_name(name, change):
    assert names(BEFORE, replace(LATER, **{"rocks": LATER.rocks, **change})) == [name]


def test_a_mission_that_begins_anew_loses_all_it_had():
    anew = Knowledge(run=2, elapsed=0.0, samples_total=4, samples_collected=0, home_error=20.0)
    found = losses_between(BEFORE, anew)
    assert [loss.name for loss in found] == ["run", "mission", "samples", "home", "map", "rocks"]
    assert found[0].text == "run 1 became run 2"
    assert found[2].text == "2 of 6 samples became 0 of 4"
    assert "(10.0, 20.0), (30.0, 40.0), (70.0, 40.0)" in found[-1].text


@pytest.mark.parametrize(
    "change",
    [
        {"cells": 960},  # taken back by evidence
        {"home_error": 0.6},
        {"rocks": ROCKS[1:]},  # unconfirmed by what was seen
        {"rocks": tuple(Rock(rock.id, rock.x, rock.y + 5.0) for rock in ROCKS)},  # corrected
        {"rocks": tuple(Rock(rock.id + 9, rock.x, rock.y + 2.0) for rock in ROCKS)},  # joined
    ],
)
def test_what_a_mission_corrects_is_no_loss(change):
    assert names(BEFORE, replace(BEFORE, **change)) == []


def test_a_loss_is_told_once():
    ledger = Ledger()
    assert ledger.losses(BEFORE) == []
    less = replace(BEFORE, cells=500, rocks=(), home_error=9.0, samples_collected=0)
    assert {loss.name for loss in ledger.losses(less)} == {"map", "rocks", "home", "samples"}
    assert ledger.losses(less) == []
    assert [loss.name for loss in ledger.losses(replace(less, cells=400))] == ["map"]


def test_a_map_that_shrinks_slowly_shrinks():
    ledger = Ledger()
    told = [ledger.losses(replace(BEFORE, cells=cells)) for cells in range(1000, 900, -10)]
    assert [loss.name for losses in told for loss in losses][:1] == ["map"]


def test_a_map_that_has_just_begun_takes_back_more_but_is_not_forgotten():
    begun = replace(BEFORE, cells=237)
    assert names(begun, replace(LATER, cells=222)) == []
    assert names(begun, replace(LATER, cells=70)) == ["map"]
