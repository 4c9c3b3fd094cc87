"""Choose a DDS domain that no other run on this machine uses."""

from __future__ import annotations

import fcntl
import os
import random
import tempfile
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

from rover_common.errors import RoverError

# Domain d uses UDP ports from 7400 + 250 d; above 101 they reach the ephemeral ports.
DOMAINS = range(1, 100)
HIGHEST = 232  # the last whose ports exist


class DomainError(RoverError):
    """ROS_DOMAIN_ID is no domain, or every domain is held by another run."""


def chosen_domain() -> int | None:
    """ROS_DOMAIN_ID, or None where it is not set; raises DomainError."""
    chosen = os.environ.get("ROS_DOMAIN_ID")
    if not chosen:
        return None
    if not (chosen.isdecimal() and int(chosen) <= HIGHEST):
        raise DomainError(f"ROS_DOMAIN_ID={chosen} is no domain: 0 to {HIGHEST}")
    return int(chosen)


@contextmanager
def reserved_domain() -> Iterator[int]:
    """ROS_DOMAIN_ID where it is set, otherwise a free domain; held until the block ends.

    Raises DomainError.
    """
    chosen = chosen_domain()
    with free_domain() if chosen is None else _shared_domain(chosen) as domain:
        yield domain


@contextmanager
def free_domain() -> Iterator[int]:
    """A domain that no other run holds, held until the block ends; raises DomainError."""
    for domain in random.sample(DOMAINS, len(DOMAINS)):
        try:
            handle = _lock_of(domain).open("w")
        except PermissionError:  # another user's
            continue
        with handle:
            try:
                fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                continue
            yield domain
            return
    raise DomainError("all DDS domains are in use; end another run or set ROS_DOMAIN_ID")


@contextmanager
def _shared_domain(domain: int) -> Iterator[int]:
    """No free one for others until the block ends; whoever is told to use it may share it."""
    with ExitStack() as stack:
        with suppress(PermissionError, BlockingIOError):  # another user's, or held by who set it
            handle = stack.enter_context(_lock_of(domain).open("w"))
            fcntl.flock(handle, fcntl.LOCK_SH | fcntl.LOCK_NB)
        yield domain


def _lock_of(domain: int) -> Path:
    return Path(tempfile.gettempdir()) / f"rover-domain-{domain}.lock"
