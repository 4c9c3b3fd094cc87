"""The simulator's end of the Socket.IO connection."""
