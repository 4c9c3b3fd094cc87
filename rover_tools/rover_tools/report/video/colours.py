"""The colours of the report's dark scheme, as RGB; see templates/colours.css and map.css."""

from __future__ import annotations

Colour = tuple[int, int, int]

PAGE: Colour = (16, 19, 22)
PANEL: Colour = (26, 30, 35)
INK: Colour = (236, 239, 241)
MUTED: Colour = (163, 173, 183)
UNKNOWN: Colour = (38, 43, 49)
GROUND: Colour = (90, 101, 112)
OBSTACLE: Colour = (5, 6, 7)
ORANGE: Colour = (230, 159, 0)
YELLOW: Colour = (240, 228, 66)
GREEN: Colour = (47, 199, 155)
BLUE: Colour = (58, 140, 204)
SKY: Colour = (165, 220, 255)
VERMILLION: Colour = (239, 122, 45)
PURPLE: Colour = (204, 121, 167)

STATES: dict[str, Colour] = {
    "FORWARD": BLUE,
    "STOP": SKY,
    "ROCK_APPROACH": ORANGE,
    "PICKUP": GREEN,
    "RETURN_HOME": PURPLE,
    "STUCK": VERMILLION,
    "TILT": VERMILLION,
    "CIRCLE": VERMILLION,
    "DONE": INK,
    "EXPLORING": BLUE,
    "GOAL_NAVIGATION": ORANGE,
    "LAUNCHING": GREEN,
    "ATTEMPTING_RAMP": PURPLE,
    "RETURNING": SKY,
    "TILT_INTERRUPT": VERMILLION,
    "FAILED": VERMILLION,
}


def colour_of(state: str) -> Colour:
    """Muted for a state in which nothing happens."""
    return STATES.get(state, MUTED)
