"""What only watches gives way to what drives."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path

NICENESS = 10
AUTOGROUP = Path("/proc/self/autogroup")  # Linux shares the processor among sessions by this one


def give_way() -> None:
    """Let this process have the processor when the others leave it; where it cannot, go on."""
    with suppress(OSError):
        os.nice(NICENESS)
        AUTOGROUP.write_text(str(NICENESS))
