"""Maps of whole missions under a rough driver."""

import json

from rover_simulator.world.generator import generate_world
from rover_tools.benchmarks import tours as bench_tours


def test_a_rough_tour_is_scored_against_the_truth(tmp_path, monkeypatch, capsys):
    small = generate_world(3, size=0.3)
    monkeypatch.setattr(bench_tours, "generate_world", lambda seed: small)
    arguments = ["--seeds", "3", "--drivers", "rough", "--time-limit", "40", "--json"]
    assert bench_tours.main([*arguments, "--out", str(tmp_path)]) == 0
    (row,) = json.loads(capsys.readouterr().out.splitlines()[0])["tours"]
    assert row["tilt_max_deg"] > 3.0
    assert row["percent_mapped"] > 15
    assert row["fidelity"] > 90
    assert row["rocks_false"] == 0
    assert (tmp_path / f"{small.name}-rough.png").stat().st_size > 1000
