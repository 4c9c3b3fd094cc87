"""The explorers by name; a package adds its own as an entry point of this group."""

from __future__ import annotations

from rover_common.registry import Registry

_HERE = "rover_decision.missions.sample_return"
EXPLORERS = Registry(
    "explorer",
    "rover.explorers",  # each an instance of explorer.Explorer
    {
        "tour": f"{_HERE}.explorer:TOUR",
        "frontier": f"{_HERE}.explorer:FRONTIER",
        "classic_a": f"{_HERE}.classic.solutions:CLASSIC_A",
        "classic_b": f"{_HERE}.classic.solutions:CLASSIC_B",
    },
)
