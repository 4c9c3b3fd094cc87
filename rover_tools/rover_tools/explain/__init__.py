"""One camera image through every stage of perception, as a picture beside the baseline."""
