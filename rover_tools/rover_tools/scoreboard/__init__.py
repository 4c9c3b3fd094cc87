"""Many missions: worlds x seeds x strategies, run in parallel, in one table."""
