"""`rover view RUN`."""

from __future__ import annotations

from pathlib import Path

import click

from rover_common.command_line import Whole
from rover_tools.cli.options import FILE_OR_FOLDER, open_option


@click.command("view")
@click.argument("recording", type=FILE_OR_FOLDER, metavar="RUN")
@click.option("--port", type=Whole(0, 65535), default=8080, show_default=True, metavar="N",
              help="TCP port of the page; 0, or where it is taken, any free one.")  # fmt: skip
@open_option
def command(recording: Path, port: int, open_page: bool) -> None:
    """Show a recording on the live page, with a slider for its time, until Ctrl-C.

    RUN is a result folder, the folder of a recording, or its .mcap file.

    \b
    Examples:
      ./rover view results/demo --open
      ./rover view recordings/first
    """
    import asyncio
    import webbrowser
    from contextlib import suppress

    from rover_dashboard.view import serve_recording
    from rover_recorder.reader import open_recording
    from rover_tools.output import note
    from rover_tools.runner.graph import HOST, free_port

    def ready(address: str) -> None:
        note(f"{recording} is shown at {address}; Ctrl-C ends it")
        if open_page:
            webbrowser.open(address)

    opened = open_recording(recording)
    chosen = free_port(port) if port else 0
    with suppress(KeyboardInterrupt):
        asyncio.run(serve_recording(opened, opened.topics, HOST, chosen, ready))
