"""Fidelity over percent mapped, as a figure."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from matplotlib.figure import Figure

from rover_common.whole_file import whole_file
from rover_tools.evaluation.scoring import MapScore

STYLES = {"ours": ("#2b6cb0", "-"), "baseline": ("#d7443e", "--")}


@dataclass(frozen=True)
class Curve:
    sequence: str
    method: str  # a key of STYLES
    scores: list[MapScore]


def draw_curves(path: Path, curves: list[Curve]) -> None:
    """Write a PNG with one panel for each sequence."""
    sequences = list(dict.fromkeys(curve.sequence for curve in curves))
    figure = Figure(figsize=(3.2 * len(sequences), 3.4), layout="constrained")
    panels = figure.subplots(1, len(sequences), squeeze=False, sharey=True)[0]
    for panel, sequence in zip(panels, sequences, strict=True):
        for curve in (curve for curve in curves if curve.sequence == sequence):
            color, line = STYLES[curve.method]
            mapped = [score.percent_mapped for score in curve.scores]
            fidelity = [score.fidelity for score in curve.scores]
            panel.plot(mapped, fidelity, line, marker=".", color=color, label=curve.method)
        panel.set(title=sequence, xlabel="mapped [%]")
        panel.grid(alpha=0.3)
    panels[0].set_ylabel("fidelity [%]")
    panels[0].legend(loc="lower left")
    with whole_file(path) as draft:
        figure.savefig(draft, dpi=110, format="png")
