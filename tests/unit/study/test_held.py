"""`rocking strengthen`: table and figure of what holds a structure of a study; what it refuses leaves no trace."""

import csv

import numpy as np
import pytest
import yaml

import rocking
from rocking.study.cli import main
from rocking.study.strengthening import StrengtheningRow
from rocking.tables import read_rows
from tests.made_pools import DESIGN, made_pool

STRUCTURES = """
- {name: "parapet / low", type: block, breadth_m: 0.2, height_m: 2.0}
- {name: tied, type: facade, storey_heights_m: [4.0], thicknesses_m: [0.4], unit_weight_kN_m3: 18, restitution: 0.8,
   behind: cross_walls, tie_heights_m: [3.8], tie_stiffness_kN_m2: 5000, tie_strength_kN_m: 5}
"""
STATIONS = 6


@pytest.fixture
def study(tmp_path):
    """A study of six stations with two components each."""
    folder = tmp_path / "study"
    (folder / "records").mkdir(parents=True)
    rows = []
    for name, pair in made_pool(STATIONS).items():
        for place, component in enumerate(pair):
            lines = [
                f"{t:.2f} {a:.17g}" for t, a in zip(component.times, component.acceleration, strict=True)
            ]
            file = f"{name}_{place}.txt"
            (folder / "records" / file).write_text("\n".join(lines) + "\n")
            direction = "NS" if place else "EW"
            rows.append(
                {"id": file[:-4], "file": file, "unit": "m/s2", "station": name}
                | {"event": "made", "component": direction}
            )
    with (folder / "records" / "catalogue.csv").open("w", newline="") as stream:
        writer = csv.DictWriter(stream, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    (folder / "structures.yaml").write_text(STRUCTURES)
    (folder / "config.yaml").write_text(yaml.safe_dump({"processing": {"apply": "never"}}))
    return folder


@pytest.mark.slow
def test_what_holds_a_parapet_is_what_python_says_of_the_same_records(study, capsys):
    assert main(["strengthen", str(study), "parapet / low", "breadth_m", "0.2..1.6", "--target", "0.3"]) == 0
    told = capsys.readouterr().out
    table = study / "results" / "strengthening" / "parapet_low_breadth_m.csv"
    assert str(table) in told and table.with_suffix(".svg").read_text().startswith("<?xml")
    given, *tried = read_rows(StrengtheningRow, table)
    assert given.is_given and given.value == 0.2 and len(tried) == 15
    records = [component for pair in made_pool(STATIONS).values() for component in pair]
    names = [name for name in made_pool(STATIONS) for _ in range(2)]
    parapet = rocking.Block.of_size(breadth=0.2, height=2.0)
    found = rocking.strengthen(records, parapet, "breadth", between=(0.2, 1.6), target=0.3, stations=names)
    assert [this_trial.overturning_share for this_trial in tried] == [
        other_trial.share for other_trial in found.tried
    ]
    assert [trial.holds for trial in tried] == [trial.value >= found.value for trial in found.tried]
    assert {one_trial.stations for one_trial in tried} == {STATIONS}


@pytest.mark.process
def test_a_tie_is_typed_in_kilonewtons_and_sized_by_the_code_beside(study, capsys):
    """At a design level each record has the factor that brings its spectrum to the target in the mean."""
    config = {**DESIGN, "processing": {"apply": "never"}}
    (study / "config.yaml").write_text(yaml.safe_dump(config))
    output = study / "own"
    arguments = ["strengthen", str(study), "tied", "tie_strength_kN_m", "2..40"]
    assert main([*arguments, "--output", str(output)]) == 0
    given, *tried = read_rows(StrengtheningRow, output / "tied_tie_strength_kN_m.csv")
    assert given.value == 5 and (tried[0].value, tried[-1].value) == (2, pytest.approx(40))
    assert not np.isnan(given.static_tie)
    assert "The linear check of the code asks for" in capsys.readouterr().out


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (
            ["nobody", "breadth_m", "0.2..1"],
            "structure is 'nobody', but must be one of those in structures.yaml",
        ),
        (["parapet / low", "thickness_m", "0.2..1"], "a block has no such size"),
        (["parapet / low", "breadth_m", "0.2-1"], "must be two numbers with two points between them"),
        (["parapet / low", "breadth_m", "1..0.2"], "must go from above 0 to a larger value"),
        (["parapet / low", "breadth_m", "0.2..1", "--target", "0"], "target is 0"),
        (["tied", "tie_strength_kN_m", "2..1e40"], "with tie_strength_kN_m = "),
    ],
)
def test_bad_input_is_refused_in_one_sentence_and_leaves_no_trace(study, capsys, arguments, sentence):
    before = set(study.rglob("*"))
    assert main(["strengthen", str(study), *arguments]) == 2
    told = capsys.readouterr().err
    assert sentence in told and told.count("\n") == 1
    assert set(study.rglob("*")) == before
