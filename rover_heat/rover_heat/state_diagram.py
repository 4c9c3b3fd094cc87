"""`python -m rover_heat.state_diagram docs/heat.md`: the machine, drawn into a document.

Writes a Mermaid diagram and a table of the events between the document's two markers.
"""

from __future__ import annotations

import sys

from rover_decision.state_diagram import Drawing
from rover_heat.mission.chart import Event, HeatChart, transitions

HEAT = Drawing(HeatChart, Event, transitions(), "rover_heat.state_diagram")

if __name__ == "__main__":
    sys.exit(HEAT.write(sys.argv[1:], __doc__))
