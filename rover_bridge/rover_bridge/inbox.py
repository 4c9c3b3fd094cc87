"""Events on their way from the transport's thread to the node's: the clients take turns.

A client that sends much waits behind itself, never the others behind it. The transport bounds what
one client has waiting here, as it reads no more of a client that is owed many answers.
"""

from __future__ import annotations

import threading
from collections import OrderedDict, deque

from rover_bridge.transport import ServerEvent

MAX_REPORTS = 64  # events of no client that wait; more of them tell nothing new


class Inbox:
    """The order of one client's events is kept."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._queues: OrderedDict[str, deque[ServerEvent]] = OrderedDict()

    def put(self, event: ServerEvent) -> None:
        """From any thread."""
        client = getattr(event, "client", "")
        with self._lock:
            queue = self._queues.setdefault(client, deque())
            if client or len(queue) < MAX_REPORTS:
                queue.append(event)

    def take(self) -> ServerEvent | None:
        """The oldest event of the client whose turn it is; None when nothing waits."""
        with self._lock:
            if not self._queues:
                return None
            client, queue = self._queues.popitem(last=False)
            event = queue.popleft()
            if queue:
                self._queues[client] = queue  # its next turn comes after all others
            return event
