"""The base class of every error that a program of this project expects."""

from __future__ import annotations

CANNOT_START = 78  # exit code of a node that would fail again: EX_CONFIG of sysexits.h


class RoverError(Exception):
    """Something that the user or the caller can act on; its text says what is wrong.

    A subclass may have a built-in exception as its second base where callers rely on it. A command
    reports such an error in one line; any other exception is a defect and keeps its traceback.
    """
