"""What became of a mission with faults: its result, its table of faults, and its verdict."""

from __future__ import annotations

import csv
import io
from collections import Counter
from collections.abc import Mapping, Sequence
from pathlib import Path

from rover_common.whole_file import write_whole
from rover_tools.chaos.executor import Outcome
from rover_tools.chaos.losses import Loss
from rover_tools.chaos.plan import Kind
from rover_tools.evaluation.results import Result

FAULTS = "faults.csv"
HOME = 2.0  # [m] of the start within which the rover is home
COLUMNS = (
    "number", "kind", "target", "planned_s", "began_s", "seconds", "recovered_s", "lost",
)  # fmt: skip


def fault_line(outcome: Outcome) -> str:
    """For the user who waits."""
    recovered = outcome.recovered
    then = "the mission ended" if recovered is None else f"all at work after {recovered:.1f} s"
    lost = "; ".join(f"lost {loss.name}: {loss.text}" for loss in outcome.losses)
    text = f"{outcome.began:6.1f} s  {outcome.fault.text}: {then}"
    return f"{text}; {lost}" if lost else text


def chaos_result(
    mission: Result,
    outcomes: Sequence[Outcome],
    at_end: Sequence[Loss],
    respawns: Mapping[str, int],
    simulated: Mapping[str, float],
) -> Result:
    """The mission's result, and what its faults did.

    at_end: losses after the last fault; respawns: by node; simulated: the simulator's last line of
    progress.
    """
    recovered = [o.recovered for o in outcomes if o.recovered is not None]
    killed = Counter(o.fault.target for o in outcomes if o.fault.kind is Kind.KILL)
    lost = [
        f"fault {o.fault.number}, {o.fault.text}: {loss.name}: {loss.text}"
        for o in outcomes
        for loss in o.losses
    ]
    return mission | {
        "faults": len(outcomes),
        "faults_by_kind": dict(Counter(str(o.fault.kind) for o in outcomes)),
        "lost": lost + [f"at the end: {loss.name}: {loss.text}" for loss in at_end],
        "worst_brake_ms": round(1e3 * simulated.get("longest_unbraked", 0.0)),
        "dead_man_stops": simulated.get("dead_man_stops", 0),
        "worst_recovery_s": round(max(recovered), 1) if recovered else None,
        # Nodes that no fault killed: a defect, also where nothing was lost by it.
        "ended_by_themselves": {
            name: times - killed[name]
            for name, times in respawns.items()
            if times > killed[name]
        },
    }  # fmt: skip


def unharmed(result: Result) -> bool:
    """Whether the rover is home with all samples, and nothing was lost."""
    home = bool(result["done"]) and result["home_distance"] <= HOME
    return home and result["samples_collected"] == result["samples_total"] and not result["lost"]


def write_faults(folder: Path, outcomes: Sequence[Outcome]) -> None:
    """One row for each fault that came."""
    text = io.StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(COLUMNS)
    for outcome in outcomes:
        fault, recovered = outcome.fault, outcome.recovered
        table.writerow((
            fault.number, fault.kind, fault.target, fault.at, f"{outcome.began:.2f}",
            f"{outcome.ended - outcome.began:.2f}", "" if recovered is None else f"{recovered:.2f}",
            "; ".join(f"{loss.name}: {loss.text}" for loss in outcome.losses),
        ))  # fmt: skip
    write_whole(folder / FAULTS, text.getvalue())
