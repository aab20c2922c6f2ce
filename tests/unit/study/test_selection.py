"""`rocking select`: a catalogue of the chosen records with factors, which a study takes as it is; what it refuses."""

import csv
from dataclasses import replace

import numpy as np
import pytest
import yaml

from rocking.catalogue import load_catalogue, open_station
from rocking.study.cli import main
from rocking.study.selection import joined_by_station
from rocking.study.settings import read_settings
from tests.made_pools import DESIGN, LEVEL, SETS, made_pool


@pytest.fixture
def study(tmp_path):
    """A study whose pool holds twelve stations, one of which cannot be read, and a factor of two on one row."""
    folder = tmp_path / "study"
    (folder / "records").mkdir(parents=True)
    rows = []
    for name, (first, _) in made_pool(12).items():
        lines = [f"{t:.2f} {a:.9f}" for t, a in zip(first.times, first.acceleration, strict=True)]
        (folder / "records" / f"{name}.txt").write_text("\n".join(lines) + "\n")
        rows.append(
            {
                "id": name,
                "file": f"{name}.txt",
                "unit": "m/s2",
                "station": name,
                "scale_factor": 2 if name == "R1" else "",
            }
        )
    rows.append({"id": "gone", "file": "gone.txt", "unit": "m/s2", "station": "gone", "scale_factor": ""})
    with (folder / "records" / "catalogue.csv").open("w", newline="") as stream:
        writer = csv.DictWriter(stream, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    config = {**DESIGN, "processing": {"apply": "never"}}
    (folder / "config.yaml").write_text(yaml.safe_dump(config))
    return folder


def test_two_rows_of_one_station_and_earthquake_are_one_pair_with_one_factor(study, capsys):
    """R1 and R2 become the two components of a station: eleven stations are left, and both rows get its factor."""
    path = study / "records" / "catalogue.csv"
    with path.open(newline="") as stream:
        rows = list(csv.DictReader(stream))
    for row in rows:
        row |= {"event": "made", "component": ""}
        if row["id"] in ("R1", "R2"):
            row |= {"station": "both", "component": {"R1": "EW", "R2": "NS"}[row["id"]], "scale_factor": ""}
    with path.open("w", newline="") as stream:
        writer = csv.DictWriter(stream, list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)
    pool = {
        one_record.id: [open_station(one_record).horizontal[0]]
        for one_record in load_catalogue(path)
        if one_record.id != "gone"
    }
    joined = joined_by_station(pool)
    assert len(joined) == 11
    assert [record.component for record in joined["R1 + R2"]] == ["EW", "NS"]
    config = yaml.safe_load((study / "config.yaml").read_text())
    config["checks"]["stations"] = 11
    config["checks"]["largest_factor"] = 100.0
    (study / "config.yaml").write_text(yaml.safe_dump(config))
    assert main(["select", str(study)]) == 0
    assert "11 records of as many stations out of 11" in capsys.readouterr().out
    factors = {
        other_record.id: other_record.scale_factor
        for other_record in load_catalogue(study / "records" / "selected.csv")
    }
    assert len(factors) == 12
    assert factors["R1"] == factors["R2"]


def test_components_that_may_be_of_two_earthquakes_are_not_joined():
    """No earthquake is named, or three rows share one, or both rows hold the same component."""
    (first, second), *_ = made_pool(1).values()

    def row(component, event, station="both"):
        return [replace(first, component=component, event=event, station=station)]

    for pool in (
        {"a": row("EW", ""), "b": row("NS", "")},
        {"a": row("EW", "one"), "b": row("NS", "two")},
        {"a": row("EW", "one"), "b": row("NS", "one"), "c": row("N45", "one")},
        {"a": row("EW", "one"), "b": row("EW", "one")},
        {"a": row("EW", "one", ""), "b": row("NS", "one", "")},
        {"a": [first, second], "b": row("NS", "one")},
    ):
        assert joined_by_station(pool).keys() == pool.keys()


def test_the_catalogue_of_the_set_holds_the_factors_and_can_be_opened(study, capsys):
    assert main(["select", str(study)]) == 0
    told = capsys.readouterr().out
    assert "gone: not used" in told and "3 records of as many stations out of 12" in told
    pool = {record.id: record for record in load_catalogue(study / "records" / "catalogue.csv")}
    chosen = load_catalogue(study / "records" / "selected.csv")
    assert len(chosen) == 3
    for name in chosen:
        factor = name.scale_factor / pool[name.id].scale_factor
        assert f"{name.id}: factor {factor:.4g}" in told
        ratio = (
            open_station(name).horizontal[0].acceleration
            / open_station(pool[name.id]).horizontal[0].acceleration
        )
        np.testing.assert_allclose(ratio, factor, rtol=1e-9)
    first = (study / "records" / "selected.csv").read_bytes()
    assert b"target" in (study / "records" / "selected.svg").read_bytes()
    main(["select", str(study)])
    assert (study / "records" / "selected.csv").read_bytes() == first


def _level(**values: object) -> dict[str, object]:
    return {**DESIGN, "design_spectrum": LEVEL | values}


def _sets(**values: object) -> dict[str, object]:
    return {**DESIGN, "checks": SETS | values}


@pytest.mark.parametrize(
    ("design", "sentence"),
    [
        ({}, "records are selected for a design level"),
        (_level(f0=None), "setting design_spectrum.f0 is missing, but must be given with ag_g."),
        (_level(soil="F"), "setting design_spectrum.soil is 'F', but must be A or B or C or D or E."),
        (_sets(confidence_factor=0.9), "confidence_factor is 0.9, but must be a number from 1 to 2."),
        (_level(points="site.csv"), "one of the two must be null"),
        (_sets(stations=40), "a set of 40 needs as many"),
        (_sets(largest_factor=0.26), "no set of 3 stations lies within -10 and +30 % of the target"),
    ],
)
def test_what_cannot_be_selected_is_refused_in_a_sentence(study, capsys, design, sentence):
    (study / "config.yaml").write_text(yaml.safe_dump(design))
    assert main(["select", str(study)]) == 2
    assert sentence in capsys.readouterr().err
    assert not (study / "records" / "selected.csv").exists()


def test_the_catalogue_itself_is_never_written_over(study, capsys):
    catalogue = study / "records" / "catalogue.csv"
    before = catalogue.read_bytes()
    assert main(["select", str(study), "--output", str(catalogue)]) == 2
    assert main(["select", str(study), "--output", str(study / "other.csv")]) == 2
    assert "as the paths of the catalogue start there" in capsys.readouterr().err
    assert catalogue.read_bytes() == before


def test_points_of_a_file_are_a_design_level(tmp_path):
    path = tmp_path / "site.csv"
    path.write_text("period_s,acceleration_g\n0,0.2\n2,0.1\n")
    spectrum = read_settings({"design_spectrum": {"points": str(path)}}).design_spectrum.spectrum()
    assert spectrum.level == pytest.approx(0.2 * 9.80665)
    assert read_settings({}).design_spectrum.spectrum() is None
