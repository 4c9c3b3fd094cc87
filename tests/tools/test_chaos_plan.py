"""The plan of faults: by the seed alone, and never two faults at a time."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise

import pytest

from rover_tools.chaos.graph_shapes import GraphShape
from rover_tools.chaos.node_graph_faults import JUNK
from rover_tools.chaos.plan import FIRST, GAPS, SHAPES, Kind, plan_faults
from rover_tools.runner.graph import NODES

LONG = 3600.0  # [s]


def test_the_same_seed_has_the_same_plan_and_another_seed_another_one():
    assert plan_faults(3, LONG) == plan_faults(3, LONG)
    assert plan_faults(3, LONG) != plan_faults(4, LONG)


def test_a_shorter_time_has_the_beginning_of_the_same_plan():
    longer = plan_faults(3, LONG)
    shorter = plan_faults(3, 100.0)
    assert 0 < len(shorter) < len(longer)
    assert longer[: len(shorter)] == shorter
    assert shorter[-1].at < 100.0


def test_there_is_no_fault_in_no_time():
    assert plan_faults(3, 0.0) == ()


@pytest.mark.parametrize("seed", range(5))
def test_no_fault_begins_before_the_one_before_is_over(seed):
    plan = plan_faults(seed, LONG)
    assert plan[0].at == FIRST
    assert [fault.number for fault in plan] == list(range(1, len(plan) + 1))
    for first, second in pairwise(plan):
        rest = SHAPES[first.kind].rest + GAPS[0]
        assert second.at >= first.at + first.seconds + rest - 0.02, (first, second)


@pytest.mark.parametrize("seed", range(5))
def test_every_kind_and_every_target_comes(seed):
    plan = plan_faults(seed, LONG)
    kinds = Counter(fault.kind for fault in plan)
    assert max(kinds.values()) - min(kinds.values()) <= 1
    for kind, shape in SHAPES.items():
        targets = [fault.target for fault in plan if fault.kind is kind]
        assert set(targets) == set(shape.targets)
        lasting = [fault.seconds for fault in plan if fault.kind is kind]
        assert all(shape.seconds[0] <= seconds <= shape.seconds[1] for seconds in lasting)
    assert set(SHAPES[Kind.KILL].targets) == set(SHAPES[Kind.STOP].targets) == set(NODES)


def test_a_fault_is_told_with_its_target_and_how_long_it_lasts():
    texts = {fault.kind: fault.text for fault in plan_faults(3, LONG)}
    assert texts[Kind.KILL].startswith("kill ")
    assert " for " not in texts[Kind.KILL]
    assert texts[Kind.STOP].startswith("stop ")
    assert texts[Kind.STOP].endswith(" s")


def test_every_shape_of_the_graph_has_its_messages():
    assert set(JUNK) == set(GraphShape)
    for junk in JUNK.values():
        assert type(junk.make(5_000_000_000)) is type(junk.make(0))
