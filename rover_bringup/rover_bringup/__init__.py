"""Launch files, the parameters, the RViz view, and the rover command line."""
