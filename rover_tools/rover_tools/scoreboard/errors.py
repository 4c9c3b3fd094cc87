"""What can go wrong with a scoreboard, for the person who started it."""

from rover_common.errors import RoverError


class ScoreboardError(RoverError):
    """One sentence about what is wrong and what to do."""
