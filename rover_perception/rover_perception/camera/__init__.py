"""From pixels to classified ground."""
