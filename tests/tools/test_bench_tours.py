"""Maps of whole missions under a rough driver."""

import json

from rover_simulator.world import generator
from rover_tools.benchmarks import tours
from rover_tools.cli.main import main


def test_a_rough_tour_is_scored_against_the_truth(tmp_path, monkeypatch, capsys):
    small = generator.generate_world(3, size=0.3)
    monkeypatch.setattr(generator, "generate_world", lambda *_: small)
    monkeypatch.setattr(tours, "OWN_SECONDS", (1.0, 4.0))  # it is rough most of the time
    arguments = [
        "bench",
        "tours",
        "--seeds",
        "3",
        "--drivers",
        "rough",
        "--time-limit",
        "25",
        "--json",
    ]
    assert main([*arguments, "--out", str(tmp_path)]) == 0
    (row,) = json.loads(capsys.readouterr().out.splitlines()[0])["tours"]
    assert row["tilt_max_deg"] > 3.0
    assert row["percent_mapped"] > 15
    assert row["fidelity"] > 90
    assert row["rocks_false"] == 0
    assert (tmp_path / f"{small.name}-rough.png").stat().st_size > 1000
