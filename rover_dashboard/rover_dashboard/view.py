"""Serves a recording on the page."""

from __future__ import annotations

from collections.abc import Callable, Collection

from rover_dashboard.feed import Feed
from rover_dashboard.playback import Playback, Source
from rover_dashboard.server import Server


async def serve_recording(
    source: Source,
    names: Collection[str],
    host: str,
    port: int,
    ready: Callable[[str], None],
) -> None:
    """Serve until cancelled; `ready` is given the address once the page can be opened.

    names: of the recorded topics; port: 0 for any free one. Raises PlaybackError or PortError.
    """
    playback = Playback(source, names)
    server = Server(Feed(playback.slots, playback.history), playback, host)
    taken = await server.start(port)
    try:
        ready(f"http://{host}:{taken}/")
        await playback.run()
    finally:
        await server.close()
