"""Precision against recall of maps, as a picture."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from matplotlib.figure import Figure

from rover_tools.evaluation.scoring import MapScore

STYLES = {"ours": ("#2b6cb0", "-"), "reference": ("#d7443e", "--")}


@dataclass(frozen=True)
class Curve:
    course: str
    method: str  # a key of STYLES
    scores: list[MapScore]


def draw_curves(path: Path, curves: list[Curve]) -> None:
    """Fidelity over percent mapped, one panel for each course."""
    courses = list(dict.fromkeys(curve.course for curve in curves))
    figure = Figure(figsize=(3.2 * len(courses), 3.4), layout="constrained")
    panels = figure.subplots(1, len(courses), squeeze=False, sharey=True)[0]
    for panel, course in zip(panels, courses, strict=True):
        for curve in (curve for curve in curves if curve.course == course):
            color, line = STYLES[curve.method]
            mapped = [score.percent_mapped for score in curve.scores]
            fidelity = [score.fidelity for score in curve.scores]
            panel.plot(mapped, fidelity, line, marker=".", color=color, label=curve.method)
        panel.set(title=course, xlabel="mapped [%]")
        panel.grid(alpha=0.3)
    panels[0].set_ylabel("fidelity [%]")
    panels[0].legend(loc="lower left")
    figure.savefig(path, dpi=110)
