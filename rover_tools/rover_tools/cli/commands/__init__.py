"""The commands, each declared in a file of its own; what they do is imported when they run."""
