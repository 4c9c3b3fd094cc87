"""A mission as a video: camera, vision and map side by side."""
