"""Many missions: worlds x seeds x strategies, flown in parallel, in one table."""
