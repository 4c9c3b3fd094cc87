"""The recipes by name; a package adds its own as an entry point of this group."""

from __future__ import annotations

from rover_common.registry import Registry

RECIPES = Registry(
    "recipe",
    "rover.recipes",  # each an instance of factory.Recipe
    {"exact": "rover_perception.recipes:EXACT", "baseline": "rover_perception.recipes:BASELINE"},
)
