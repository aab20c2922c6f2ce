"""A new user's walk: start, twelve files of eight formats, five structures, ten mistakes of typing, and a run."""

import csv
import shutil
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from rocking.study.cli import main
from tests.contracts import made_files

STRUCTURES = """\
- {name: pier, type: block, breadth_m: 0.5, height_m: 3.0}
- {name: attic wall, type: wall, height_m: 3.9, thickness_m: 0.3}
- {name: loaded wall, type: loaded_wall, height_m: 3.2, thickness_m: 0.25, unit_weight_kN_m3: 20, top_load_kN_m: 30,
   top_slab: flat}
- {name: façade, type: facade, storey_heights_m: [3.5, 3.0], thicknesses_m: [0.5, 0.4], unit_weight_kN_m3: 18,
   tie_heights_m: [3.4], tie_stiffness_kN_m2: 1000, tie_strength_kN_m: 4, tie_plastic_elongation_m: 0.02}
- {name: nave, type: arch_on_piers, radius_m: 5, thickness_m: 0.8, embrace_angle_deg: 150, pier_width_m: 2.2,
   pier_height_m: 4}
"""
RECORDS = {
    "RSN1_QUAKE_STA045.AT2": made_files.peer(),
    "RSN1_QUAKE_STA135.AT2": made_files.peer(0.9).replace("Station, 45", "Station, 135"),
    "MYG0010001010000.EW": made_files.knet(),
    "MYG0010001010000.NS": made_files.knet().replace("E-W", "N-S"),
    "cosmos.v2": made_files.cosmos(),
    "csmip.v2": made_files.csmip(),
    "usgs.smc": made_files.smc(),
    "esm.asc": made_files.dyna(),
    "geonet.v2a": made_files.geonet(),
    "jma.csv": made_files.jma(),
    "afad.txt": made_files.afad(),
    "resorce.acc": made_files.resorce(),
}


@pytest.fixture(scope="module")
def begun(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A study as its user made it, by the commands that each step names for the next."""
    folder = tmp_path_factory.mktemp("walk") / "my church"
    assert main(["start", str(folder)]) == 0
    for name, text in RECORDS.items():
        (folder / "records" / name).write_bytes(text.encode("latin-1"))
    (folder / "structures.yaml").write_text(STRUCTURES, encoding="utf-8")
    assert main(["catalogue", str(folder / "records")]) == 0
    return folder


@pytest.fixture
def study(begun: Path, tmp_path: Path) -> Path:
    """A copy of it, which a test may change."""
    return shutil.copytree(begun, tmp_path / "my church")


def test_every_file_is_in_the_catalogue_and_a_pair_shares_its_row(study: Path) -> None:
    with (study / "records" / "catalogue.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.DictReader(stream))
    files = [row["file"].split(";") for row in rows]
    assert sorted(name for names in files for name in names) == sorted(RECORDS)
    pairs = sorted(sorted(names) for names in files if len(names) == 2)
    assert pairs == [
        ["MYG0010001010000.EW", "MYG0010001010000.NS"],
        ["RSN1_QUAKE_STA045.AT2", "RSN1_QUAKE_STA135.AT2"],
    ]


def _replaced(old: str, new: str) -> Callable[[str], str]:
    return lambda text: text.replace(old, new, 1)


def _added(lines: str) -> Callable[[str], str]:
    return lambda text: f"{text}{lines}\n"


MISTAKES: dict[str, tuple[str, Callable[[str], str], tuple[str, ...]]] = {
    "decimal comma": ("structures.yaml", _replaced("height_m: 3.9", "height_m: 3,9"), ("attic wall", "3.9")),
    "decimal comma in a block": (
        "structures.yaml",
        lambda text: text + "- name: shed\n  type: block\n  breadth_m: 0,5\n  height_m: 3\n",
        ("shed", "'0,5'", "0.5"),
    ),
    "tab": (
        "structures.yaml",
        lambda text: text + "- name: shed\n\ttype: block\n",
        ("not valid YAML", "line"),
    ),
    "unit in the value": (
        "structures.yaml",
        _replaced("height_m: 3.9", "height_m: 3.9 m"),
        ("attic wall", "3.9 m", "number"),
    ),
    "misspelt key": (
        "structures.yaml",
        _replaced("height_m: 3.9, thickness_m", "height_m: 3.9, thicknes_m"),
        ("thicknes_m", "thickness_m"),
    ),
    "key twice": (
        "structures.yaml",
        _replaced("height_m: 3.9", "height_m: 3.9, height_m: 4.9"),
        ("'height_m' is given twice",),
    ),
    "decimal comma in a setting": ("config.yaml", _added("ensemble: {risk: '0,05'}"), ("risk", "0.05")),
    "misspelt setting": ("config.yaml", _added("tollerance: 1.0e-5"), ("tollerance", "tolerance?")),
    "unit in a setting": (
        "config.yaml",
        _added("processing: {high_pass_hz: 0.1 Hz}"),
        ("high_pass_hz", "'0.1 Hz'", "number"),
    ),
    "setting twice": (
        "config.yaml",
        _added("tolerance: 1.0e-5\ntolerance: 1.0e-5"),
        ("'tolerance' is given twice",),
    ),
    "two hashes of one file": (
        "records/catalogue.csv",
        lambda text: text.replace(";", "|"),
        ("catalogue.csv", "sha256", "64 hexadecimal digits"),
    ),
}


@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_gets_one_sentence_that_names_it_and_nothing_runs(
    study: Path, mistake: str, capsys: pytest.CaptureFixture[str]
) -> None:
    file, make, words = MISTAKES[mistake]
    path = study / file
    right = path.read_text(encoding="utf-8")
    path.write_text(make(right), encoding="utf-8")
    assert path.read_text(encoding="utf-8") != right
    assert main(["run", str(study)]) == 2
    told = capsys.readouterr().err
    assert "Traceback" not in told and len(told.splitlines()) == 1, told
    for word in words:
        assert word in told, told
    assert not (study / "results").exists()


@pytest.mark.slow
def test_the_walk_ends_with_a_verdict_on_every_structure_under_every_record(study: Path, start) -> None:
    """Of the made records, of 0.4 s each, some say too little; none costs another its result."""
    (study / "config.yaml").write_text("ensemble: {members: 16}\nreports: false\n", encoding="utf-8")
    command = [sys.executable, "-m", "rocking.study.cli", "run", str(study)]
    ended = subprocess.run(command, capture_output=True, text=True, check=False, **start.surroundings)
    assert ended.returncode in (0, 1) and "Traceback" not in ended.stdout + ended.stderr, ended.stdout
    with (study / "results" / "summary" / "verdicts.csv").open(encoding="utf-8", newline="") as stream:
        verdicts = list(csv.DictReader(stream))
    assert {row["structure"] for row in verdicts} == {"pier", "attic wall", "loaded wall", "façade", "nave"}
