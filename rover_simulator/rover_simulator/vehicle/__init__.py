"""The vehicle: motion, tilt, arm."""
