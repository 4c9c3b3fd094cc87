"""From a path to a velocity: sampled predictive control, goals, recoveries."""
