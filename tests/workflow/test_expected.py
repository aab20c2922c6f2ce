"""Numbers and words of all that a study makes are those of tests/expected: an edit that changes one shows which.

`make expected` writes them anew. They hold what the package said, not what is right, which the other tests ask.
"""

import csv
import json
import os
import shutil
from collections.abc import Iterator, Mapping
from contextlib import chdir
from itertools import count
from pathlib import Path
from typing import Any

import pytest
import yaml
from matplotlib.figure import Figure

from rocking.structures.structure_list import TYPES
from rocking.study import cli
from rocking.study.jobs import run
from rocking.study.outputs import STEPS
from rocking.study.plan import make_plan
from tests.in_lines import differences, draw_in_lines, lines_of, page_in_json
from tests.made_pools import made_pool
from tests.synthetic import SyntheticRecord, synthetic_record
from tests.workflow.conftest import ROOT

EXPECTED = ROOT / "tests" / "expected"
RENEW = "ROCKING_EXPECTED"
"""The variable of the environment with which the files are written anew."""
EMPTY = {("intensity_measures.csv", name) for name in ("p_value", "power", "slope")}
EMPTY |= {("pier_breadth_m.csv", name) for name in ("governing", "static_tie")}
"""What stays empty: a regression needs more stations than these, and a pier has one crack and no tie."""

READ = {".csv", ".geojson", ".html", ".js", ".json", ".pdf", ".svg", ".xlsx", ".xml"}
"""The kinds of files that are compared."""
HIDDEN = {".kept", "provenance.json", "motion.json", "pulses.json", "predictions.json"}
"""Files that serve the next run, and that of versions and hashes."""

Row = dict[str, Any]
Entries = str | list[Row]

FEW = {"ensemble": {"members": 8}, "candidates": 2}
SETS = {"pool": "records/pool.csv", "stations": 3, "shortest_period_s": 0.6, "longest_period_s": 0.9}
LEVEL: Row = {"design_spectrum": {"ag_g": 0.2, "f0": 2.5, "tc_star_s": 0.4, "soil": "C"}}
OF_TIES = ("tie_", "unit_length", "held_between", "leaves", "bonders", "thrown", "loaded_leaf")
EXAMPLES = [
    {"name": f"{kind} {number}", "type": kind}
    | {key: value for key, value in form.example.items() if kind == "facade" or not key.startswith(OF_TIES)}
    for kind, forms in TYPES.items()
    for number, form in enumerate(forms, start=1)
    if kind != "cavity_wall"
]
"""Every form of every type with its keys; those of ties and leaves, which take long, are the facade's alone."""
STRUCTURES = """
- {name: pier, type: block, breadth_m: 0.5, height_m: 3.0, elastic_period_s: 0.12, support_loss_m: 0.2, variants: [
   {name: broader, breadth_m: 0.9}, {name: stiff, elastic_period_s: 0.05}]}
- {name: leaning, type: block, breadth_m: 0.6, height_m: 6.0, one_sided: true, restitution: 0.5, lean_deg: 1.0}
- {name: tied, type: facade, storey_heights_m: [3.5, 3.0], thicknesses_m: [0.6, 0.5], unit_weight_kN_m3: 20,
   floor_loads_kN_m: [12, 6], tie_heights_m: [3.4], tie_stiffness_kN_m2: 1000, tie_strength_kN_m: 4, behind: floors,
   restitution: 0.5}
- {name: tower, type: support, modes: [{period_s: 0.5, participation: 1.3}, {period_s: 0.12, participation: -0.4}],
   mass_ratio: 0.1}
- {name: statue, type: block, breadth_m: 0.7, height_m: 1.9, stands_on: tower}
- {name: roof, type: support, period_s: 0.3, storeys: 3, height_m: 6.0, building_height_m: 9.0}
- {name: parapet, type: parapet, height_m: 1.5, thickness_m: 0.4, stands_on: roof}
"""
OF_FRAGILITY = """
- {name: pier, type: block, breadth_m: 0.5, height_m: 3.0}
- {name: roof, type: support, period_s: 0.3, participation: 1.3}
- {name: parapet, type: parapet, height_m: 1.5, thickness_m: 0.4, stands_on: roof}
- {name: held, type: loaded_wall, height_m: 3.2, thickness_m: 0.25, unit_weight_kN_m3: 20, hinge_height_m: 1.9,
   crack: known, tie_heights_m: [1.6], tie_stiffness_kN_m2: 5.0e4, one_sided: true, restitution: 0.7}
"""
ALONE = """
- {name: facade, type: block, breadth_m: 0.5, height_m: 6.0, one_sided: true, restitution: 0.5}
- {name: too stiff, type: support, period_s: 0.001, participation: 1.0}
- {name: instrument, type: block, breadth_m: 0.5, height_m: 2.0, stands_on: too stiff}
"""
IN_CONTACT = """
- {name: stocky, type: block, breadth_m: 2.0, height_m: 4.0}
"""
STUDIES: Mapping[str, tuple[Entries, list[str], Row]] = {
    "types": (EXAMPLES, ["near"], {"ensemble": {"members": 8, "reserve": 0}, "candidates": 1, **LEVEL}),
    "level": (
        STRUCTURES,
        ["near", "far", "made", "unnamed", "broken"],
        {
            **FEW, **LEVEL, "checks": SETS, "study": "A study", "client": "A client", "language": "it",
            "display_units": "g and cm", "vertical": True, "trade": {"in_summary": True},
        },
    ),
    "fragility": (
        OF_FRAGILITY,
        ["near", "far", "unnamed", "broken"],
        {
            "ensemble": {"members": 0}, "candidates": 2, "fidelity": "quick", "histories": True,
            "fragility": {"in_every_run": True, "intensity_measure": "pga", "hazard": "hazard.csv", "members": False},
        },
    ),
    "alone": (ALONE, ["raw", "pair", "near"], {"fidelity": "quick", "reports": False, "candidates": 2}),
    "contact": (
        IN_CONTACT,
        ["strong"],
        {**FEW, "fidelity": "contact", "reports": False, "vertical": True, "friction_coefficient": 0.6},
    ),
}  # fmt: skip
"""Structures, records and settings of each study, by its name."""
COMMANDS: Mapping[str, tuple[tuple[str, ...], ...]] = {
    "level": (
        ("read", "records/near_0.txt", "--unit", "m/s2", "--details"),
        ("pulse", "records/near_0.txt", "--unit", "m/s2"),
        (
            "assess",
            "records/near_0.txt",
            "--unit",
            "m/s2",
            "--structures",
            "structures.yaml",
            "--name",
            "pier",
        ),
        ("spectrum", "records/near_0.txt", "--unit", "m/s2", "--output", "results/spectrum.csv"),
        ("select", "."),
        ("strengthen", ".", "pier", "breadth_m", "0.5..1.5"),
    ),
}
"""What is asked besides, by the study."""
PLACED = {
    "epicentre_latitude_deg": 42.35,
    "epicentre_longitude_deg": 13.38,
    "event": "L'Aquila",
    "magnitude": 6.1,
}
RECORDS: Mapping[str, Row] = {
    "near": {"station": "AQ", "station_latitude_deg": 42.37, "station_longitude_deg": 13.34, **PLACED},
    "far": {"station": "GS", "station_latitude_deg": 42.42, "station_longitude_deg": 13.52, **PLACED},
    "made": {"station": "none", "event": "Synthetic, not recorded", "licence": "free", "note": "made"},
    "unnamed": {"station": "", "scale_factor": 1.5},
    "broken": {"file": "broken.txt", "event": "Another"},
    "strong": {"station": "Strong", "scale_factor": 1.6},
    "pair": {"file": "20161113_110259_WTMC_20.V2A", "component": "", "unit": ""},
    "raw": {"file": "obspy:STNA.20020722.044649.evt.gz", "scale_factor": 5.0, "unit": "", "component": ""},
}
"""The cells of the catalogue by the name of a record; whose file is none of these is made."""
PEAKS: Mapping[str, tuple[float, ...]] = {"made": (4.0,), "unnamed": (4.0, 2.0), "strong": (4.0, 2.0, 9.0)}
"""Amplitudes of the pulses of records that lack a component, of two horizontal ones and a vertical one, m/s²."""


def _write_study(folder: Path, entries: Entries, names: list[str], settings: Row) -> None:
    """Write the files of a study into a folder."""
    records = folder / "records"
    records.mkdir(parents=True)
    text = entries if isinstance(entries, str) else json.dumps(entries)
    (folder / "structures.yaml").write_text(text, encoding="utf-8")
    (folder / "config.yaml").write_text(yaml.safe_dump(settings), encoding="utf-8")
    (folder / "curve.csv").write_text("displacement_m,acceleration_g\n0,0.2\n0.05,0.15\n0.4,0\n")
    (folder / "hazard.csv").write_text("level_g,annual_rate\n0.01,0.1\n10,0.00001\n")
    (records / "broken.txt").write_bytes(b"no record")
    shutil.copy(ROOT / "records" / RECORDS["pair"]["file"], records)
    rows = [_made_record(records, name) | RECORDS[name] for name in names]
    _write_catalogue(records / "catalogue.csv", rows)
    pool = [
        _written(records, name, [component.acceleration for component in pair], pair[0].time_step)
        | {"station": pair[0].station, "event": pair[0].event}
        for name, pair in made_pool(6).items()
    ]
    _write_catalogue(records / "pool.csv", pool)


def _made_record(folder: Path, name: str) -> Row:
    """Write the files of a record and return its row."""
    seed = list(RECORDS).index(name)
    recipes = [
        SyntheticRecord(
            name=name,
            seed=3 * seed + place,
            pulse_amplitude=amplitude,
            pulse_period=0.6 + 0.1 * seed,
            duration=5.0,
        )
        for place, amplitude in enumerate(PEAKS.get(name, (4.0, 2.0, 0.5)))
    ]
    return _written(folder, name, [synthetic_record(recipe).acceleration for recipe in recipes], 0.01)


def _written(folder: Path, name: str, components: list[Any], step: float) -> Row:
    files = [f"{name}_{place}.txt" for place in range(len(components))]
    for file, component in zip(files, components, strict=True):
        lines = [f"{step * place:.2f} {value:.9f}\n" for place, value in enumerate(component)]
        (folder / file).write_text("".join(lines))
    names = ("EW", "NS", "Z")[: len(components)]
    return {"id": name, "file": ";".join(files), "component": ";".join(names), "unit": "m/s2"}


def _write_catalogue(path: Path, rows: list[Row]) -> None:
    with path.open("w", encoding="utf-8", newline="") as stream:
        writer = csv.DictWriter(stream, list(dict.fromkeys(name for row in rows for name in row)))
        writer.writeheader()
        writer.writerows(rows)


def _run_study() -> None:
    """Take the study of this folder through every rule, in this process."""
    plan = make_plan(yaml.safe_load(Path("config.yaml").read_text(encoding="utf-8")))
    for record in plan.records:
        for step in STEPS:
            run(step, plan.of(record), "a log", 1, "")
    for rule in (*plan.products, "summary"):
        run(rule, plan, "a log", 1, "")


def _products(results: Path) -> Iterator[Path]:
    """The files that a person reads, but for the tables of a record that stand in those of the summary as well."""
    for path in sorted(results.rglob("*")):
        of_record = (results / "summary" / path.name).exists() and path.parent.name != "summary"
        if path.is_file() and path.suffix in READ and not (of_record or HIDDEN & {*path.parts}):
            yield path


@pytest.fixture
def undrawn_and_untimed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Documents and figures as lines, and a clock that each look moves on by a millisecond."""
    ticks = count()
    monkeypatch.setattr("rocking.reports.printing.compile_document", page_in_json)
    monkeypatch.setattr(Figure, "savefig", draw_in_lines)
    monkeypatch.setattr("rocking.products.trade.measure.machine_in_words", lambda: "a machine")
    for module in ("rocking.products.trade.measure", "rocking.strengthening", "rocking.assessment.one_case"):
        monkeypatch.setattr(f"{module}.process_time", lambda: 1e-3 * next(ticks))


@pytest.mark.filterwarnings("ignore")
@pytest.mark.usefixtures("undrawn_and_untimed")
def test_numbers_and_words_of_every_product_are_those_of_before(tmp_path, capsys, monkeypatch):
    made: dict[str, list[str]] = {}
    columns, filled = set(), set()
    for name, study in STUDIES.items():
        _write_study(tmp_path / name, *study)
        with chdir(tmp_path / name):
            _run_study()
            assert not any(cli.main(command) for command in COMMANDS.get(name, ()))
            for path in [*_products(Path("results")), *Path().glob("records/selected.csv")]:
                lines = lines_of(path)
                if (
                    lines not in made.values()
                ):  # as the description of the tables, which is the same of all studies
                    made[f"{name}/{path.parent.name}/{path.name}".replace("/results/", "/")] = lines
                if path.suffix == ".csv":
                    heads, *rows = csv.reader(path.read_text(encoding="utf-8").splitlines())
                    columns |= {(path.name, head) for head in heads}
                    filled |= {
                        (path.name, heads[place]) for row in rows for place, cell in enumerate(row) if cell
                    }
        output = capsys.readouterr()
        made[f"{name}/terminal"] = (output.out + output.err).replace(str(tmp_path), "").splitlines()
    if os.environ.get(RENEW):
        shutil.rmtree(EXPECTED, ignore_errors=True)
        for name, lines in made.items():
            target = EXPECTED / f"{name}.txt"
            target.parent.mkdir(parents=True, exist_ok=True)
            target.write_text("\n".join([*lines, ""]), encoding="utf-8")
    expected = {
        path.relative_to(EXPECTED).as_posix().removesuffix(".txt"): path.read_text(
            encoding="utf-8"
        ).splitlines()
        for path in EXPECTED.rglob("*.txt")
    }
    assert set(made) == set(expected)
    unlike = [f"{name}: {line}" for name in made for line in differences(expected[name], made[name])]
    assert not unlike, "\n".join(unlike[:40])
    assert columns - filled == EMPTY, sorted(columns - filled - EMPTY)
