"""What can go wrong with a scoreboard."""

from rover_common.errors import RoverError


class ScoreboardError(RoverError):
    """One sentence about what is wrong and what to do."""
