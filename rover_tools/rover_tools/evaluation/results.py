"""Score a run and write its result folder."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from rover_common.csv_table import CellError, TableError, read_table
from rover_common.errors import RoverError
from rover_common.ground_truth import load_truth
from rover_common.map_encoding import navigable_cells
from rover_common.types import GridMap, RockTrack
from rover_tools.evaluation.map_files import draw_map, save_map_server_pair
from rover_tools.evaluation.scoring import score_map, score_places
from rover_tools.output import write_result

Result = dict[str, Any]


class SamplesError(RoverError, ValueError):
    """The file of true sample positions cannot be read."""


@dataclass(frozen=True)
class Truth:
    """What a run is scored against; each part may be missing."""

    navigable: NDArray[np.bool_] | None = None  # (200, 200)
    samples: NDArray[np.float64] | None = None  # (n, 2) [m]

    @classmethod
    def load(cls, map_path: Path | None, samples_path: Path | None) -> Truth:
        """Raises TruthError or SamplesError."""
        return cls(
            None if map_path is None else load_truth(map_path),
            None if samples_path is None else load_samples(samples_path),
        )


def load_samples(path: Path) -> NDArray[np.float64]:
    """Sample positions (n, 2) [m] from a CSV with the columns x and y; raises SamplesError."""
    try:
        rows = read_table(path, ("x", "y"))
        places = [(row.number("x"), row.number("y")) for row in rows]
    except OSError as error:
        raise SamplesError(f"{path}: {error.strerror}") from error
    except CellError as error:
        raise SamplesError(f"{path}: {error}") from error
    except TableError as error:
        raise SamplesError(str(error)) from error
    return np.array(places, float).reshape(-1, 2)


def score(grid: GridMap | None, rocks: tuple[RockTrack, ...], truth: Truth) -> Result:
    """The scores; None where there is no truth to score against."""
    result: Result = dict.fromkeys(
        ("percent_mapped", "fidelity", "f1", "rocks_located", "rocks_missed", "rocks_false")
    )
    if truth.navigable is not None and grid is not None:
        scores = score_map(navigable_cells(grid.cells), truth.navigable)
        result["percent_mapped"] = round(scores.percent_mapped, 2)
        result["fidelity"] = round(scores.fidelity, 2)
        result["f1"] = round(scores.f1, 2)
    if truth.samples is not None:
        found = np.array([(rock.x, rock.y) for rock in rocks], float).reshape(-1, 2)
        located = score_places(found, truth.samples)
        result["rocks_located"] = located.located
        result["rocks_missed"] = located.missed
        result["rocks_false"] = located.false
    result["rocks_found"] = [
        {"x": round(r.x, 3), "y": round(r.y, 3), "observations": r.observations} for r in rocks
    ]
    return result


def percentile_ms(seconds: tuple[float, ...], percent: float) -> float:
    """A percentile of times [s], in [ms]."""
    return round(1000.0 * float(np.percentile(seconds, percent)), 3)


def write_results(
    folder: Path,
    result: Result,
    grid: GridMap | None,
    track: NDArray[np.float64],
    rocks: tuple[RockTrack, ...],
    truth: Truth,
    title: str,
) -> None:
    """Write result.json, map.png and the map_server pair worldmap.pgm + worldmap.yaml."""
    write_result(folder, result)
    if grid is None:
        return
    save_map_server_pair(grid, folder / "worldmap")
    draw_map(folder / "map.png", grid, track, rocks, truth.navigable, truth.samples, title)


def summary(result: Result) -> str:
    """The figures that people look for first, one a line."""
    lines = []
    for key, value in result.items():
        if value is None or isinstance(value, list | dict):
            continue
        lines.append(f"  {key:20} {value}")
    return "\n".join(lines)
