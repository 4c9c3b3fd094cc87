"""What can go wrong with a scoreboard, for the person who started it."""


class ScoreboardError(RuntimeError):
    """One sentence about what is wrong and what to do."""
