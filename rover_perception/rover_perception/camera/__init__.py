"""From pixels to segmented ground."""
