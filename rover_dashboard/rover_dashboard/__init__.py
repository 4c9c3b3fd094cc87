"""A live page: camera, map, state and controls of the rover in a browser."""
