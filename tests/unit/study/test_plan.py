"""The plan of a study: what is refused, how records are shared out, what makes a job run again."""

import hashlib
import os
import platform
import shutil
import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from rocking.assessment.kinds import AssessmentKind
from rocking.catalogue import CatalogueRecord
from rocking.errors import ConfigurationError
from rocking.study import settings as settings_module
from rocking.study.job import prepare
from rocking.study.plan import Plan, check_files, make_plan, study_warnings, versions
from rocking.study.settings import Settings, StudyDesign, read_settings, settings_sha256
from tests.refusals import refused

ROOT = Path(__file__).parents[3]
SHA256 = "0" * 64


@pytest.fixture(autouse=True)
def _in_the_study(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Plans are made in the folder of the study."""
    monkeypatch.chdir(tmp_path)


def _write(folder: Path, rows: str, structures: str = "", **settings: object) -> dict[str, object]:
    """Write a catalogue and a structure list into `folder` and return the settings that name them."""
    (folder / "catalogue.csv").write_text(f"id,file,sha256\n{rows}")
    block = "[{name: pier, type: block, breadth_m: 1, height_m: 6}]"
    (folder / "structures.yaml").write_text(structures or block)
    paths = {name: str(folder / name) for name in ("results", "catalogue.csv", "structures.yaml")}
    named = {"catalogue": paths["catalogue.csv"], "structures": paths["structures.yaml"]}
    return named | {"results": paths["results"]} | settings


def test_a_job_takes_what_was_prepared_unless_the_list_was_edited(tmp_path: Path) -> None:
    settings = _write(tmp_path, "a,a.AT2,\n", "[{name: wall, type: wall, height_m: 3, thickness_m: 0.25}]")
    plan = make_plan(settings)
    list(prepare(plan.settings))
    wall = plan.scenes["wall"].structure
    assert wall.__dict__["_candidates"], "it keeps its cracks"
    assert make_plan(settings).scenes["wall"].structure is wall
    listed = tmp_path / "structures.yaml"
    listed.write_text(listed.read_text().replace("0.25", "0.35"))
    assert make_plan(settings).scenes["wall"].structure.thickness == 0.35  # type: ignore[attr-defined]
    list(prepare(read_settings(settings | {"structures": str(tmp_path / "none.yaml")})))  # its jobs tell


def _refusal(settings: dict[str, object]) -> str:
    with pytest.raises(ConfigurationError) as caught:
        make_plan(settings)
    return str(caught.value)


def test_a_plan_writes_nothing_and_counts_the_content_of_a_file_whose_hash_is_blank(tmp_path: Path) -> None:
    (tmp_path / "a.AT2").write_bytes(b"one")
    settings = _write(tmp_path, "a,a.AT2,\nb,b.AT2,\n")
    before = Path(str(settings["catalogue"])).read_bytes()
    plan = make_plan(settings)
    assert plan.records["a"].sha256 == hashlib.sha256(b"one").hexdigest() and plan.records["b"].sha256 == ""
    assert Path(str(settings["catalogue"])).read_bytes() == before
    (tmp_path / "a.AT2").write_bytes(b"two")
    assert make_plan(settings).contents("read", "a") != plan.contents("read", "a")


def test_the_files_that_the_lists_name_are_those_by_which_every_job_knows_the_study(tmp_path: Path) -> None:
    """Without a shared file system a job has these and no others."""
    curve = Path("push.csv")
    curve.write_text("displacement_m,force_kN\n0,10\n0.1,8\n0.5,0\n")
    structures = (
        "[{name: pier, type: block, breadth_m: 1, height_m: 6},\n"
        " {name: tower, type: capacity_curve, file: push.csv, weight_kN: 100, restitution: 0.9}]"
    )
    settings = _write(tmp_path, "a,a.AT2,\n", structures)
    Path("layouts.csv").write_text("answer\n")
    assert make_plan(settings).listed == [
        settings["catalogue"],
        str(tmp_path / "layouts.csv"),
        settings["structures"],
        "push.csv",
    ]
    lines = "pier,block,,,,1,6", "tower,capacity_curve,push.csv,100,0.9,,"
    Path("list.csv").write_text(
        "name,type,file,weight_kN,restitution,breadth_m,height_m\n" + "\n".join(lines)
    )
    assert make_plan(settings | {"structures": "list.csv"}).listed[2:] == ["list.csv", "push.csv"]


def test_all_defects_of_all_three_files_stand_in_one_message(tmp_path: Path) -> None:
    structures = "[{name: pier, type: block, breadth_m: 1, hieght_m: 6}, {name: pier, type: blok}]"
    settings = _write(tmp_path, f"a/b,a.AT2,{SHA256}\nc,../c,1\n", structures, tolerance=5, tolerence=1e-6)
    (tmp_path / "taken").touch()
    (tmp_path / "layouts.csv").write_text("answer,hodls\n")
    message = _refusal(settings | {"results": str(tmp_path / "taken" / "results")})
    for defect in (
        "'a/b'",
        "'../c'",
        "hieght_m",
        "height_m",
        "'blok'",
        "setting tolerance",
        "tolerence",
        "'hodls'",
    ):
        assert defect in message
    assert "taken is a file, but must be a folder" in message


def test_results_that_cannot_be_written_are_refused_before_any_work(tmp_path: Path, monkeypatch) -> None:
    """Whoever runs the tests may write everywhere."""
    settings = _write(tmp_path, "a,a.AT2,\n")
    asked = []
    monkeypatch.setattr(os, "access", lambda *how: bool(asked.append(how)))
    words = f"setting results: nothing can be written in {tmp_path}; correct its permissions or name another folder."
    assert words in _refusal(settings)
    assert asked == [(tmp_path, os.W_OK | os.X_OK)]


def test_a_job_on_another_machine_needs_files_next_to_the_catalogue_and_their_hashes(tmp_path: Path) -> None:
    known = f"a,a.AT2,{SHA256}\nb,b.AT2,\n"
    plan = make_plan(_write(tmp_path, known), by_name=True)
    a, b = plan.records.values()
    assert plan.answers_of(a) == {str(tmp_path / "layouts.csv"): ""}
    Path("layouts.csv").write_text("answer\n")
    assert plan.files_of(a) == [str(tmp_path / "a.AT2")]
    assert plan.files_of(replace(a, inventory="a.xml")) == [str(tmp_path / "a.AT2"), str(tmp_path / "a.xml")]
    assert plan.files_of(replace(a, file="obspy:a")) == [], "what is fetched or installed lies nowhere"
    assert plan.answers_of(a) == {str(tmp_path / "layouts.csv"): hashlib.sha256(b"answer\n").hexdigest()}
    mirrored = make_plan(_write(tmp_path, known, mirror=str(tmp_path)), by_name=True)
    for of, record in ((plan, b), (mirrored, a)):
        with refused(ConfigurationError, "sha256", record.sha256):
            of.files_of(record)
    assert list(plan.of("b").records) == ["b"]
    with refused(ConfigurationError, "record", "c"):
        plan.of("c")


def test_a_file_or_a_library_that_is_not_there(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(ConfigurationError, match=r"setting design_spectrum\.points is 'none\.csv'"):
        check_files(Settings(design_spectrum=StudyDesign(points="none.csv")))
    monkeypatch.setattr("rocking.study.plan._LIBRARIES", ("numpy", "no-such-library"))
    assert versions.__wrapped__() == {"python": platform.python_version(), "numpy": np.__version__}


def test_what_changes_no_number_does_not_change_the_hash_of_the_settings(tmp_path: Path) -> None:
    settings = _write(tmp_path, f"a,a.AT2,{SHA256}\n")
    changes = ({}, {"reports": False}, {"results": str(tmp_path / "elsewhere")})

    def hash_of(changed: dict[str, object]) -> str:
        made = make_plan(settings | changed)
        return settings_sha256(made.settings, made.scenes)

    hashes = {hash_of(changed) for changed in changes}
    assert len(hashes) == 1
    assert hash_of({"tolerance": 1e-7}) not in hashes


def test_the_hash_of_the_package_follows_its_source(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copytree(ROOT / "rocking", tmp_path / "rocking", ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(settings_module, "__file__", str(tmp_path / "rocking" / "study" / "settings.py"))
    hashes = [settings_module.package_sha256.__wrapped__()]
    for name in ("study/plan.py", "reports/record.typ", "reports/explore.js", "reports/explore.css"):
        with (tmp_path / "rocking" / name).open("a") as stream:
            stream.write("// edited\n")
        hashes.append(settings_module.package_sha256.__wrapped__())
    (tmp_path / "rocking" / "quantities.py").rename(tmp_path / "rocking" / "measures.py")
    hashes.append(settings_module.package_sha256.__wrapped__())
    assert len(set(hashes)) == 6


COUNTS = b"000001D " + bytes(504)
"""What a miniSEED file begins with."""


def _record(folder: Path, content: bytes = b"samples", **cells: object) -> CatalogueRecord:
    (folder / "a.dat").write_bytes(content)
    return CatalogueRecord(**{"id": "a", "file": "a.dat", "sha256": "0" * 64} | cells, folder=folder)


def _hash(record: CatalogueRecord, **settings: object) -> str:
    return Plan(Settings(**settings), {"a": record}).contents("read", "a")


@pytest.mark.parametrize("when", [1e9, time.time() + 3e8], ids=["long ago", "in ten years"])
def test_a_new_date_changes_no_hash_and_a_new_content_with_the_old_date_does(tmp_path, when) -> None:
    record = _record(tmp_path)
    before, file = _hash(record), tmp_path / "a.dat"
    os.utime(file, (when, when))
    assert _hash(record) == before
    file.write_bytes(b"Samples")
    os.utime(file, (when, when))
    assert _hash(record) != before


@pytest.mark.parametrize(
    ("cells", "content", "file", "counts"),
    [
        ({"inventory": "x.xml"}, COUNTS, "x.xml", True),
        ({}, COUNTS, "x.xml", True),
        ({}, b"\x1f\x8b packed", "x.xml", True),
        ({"unit": "m/s2"}, COUNTS, "x.xml", False),
        ({}, b"text", "x.xml", False),
        ({"file": "a.dat;v.dat", "sha256": ""}, b"text", "v.dat", True),
    ],
    ids=["named StationXML", "StationXML beside", "packed", "declared unit", "no miniSEED", "second file"],
)
def test_every_file_that_is_read_counts_and_no_other(tmp_path, cells, content, file, counts) -> None:
    record = _record(tmp_path, content, **cells)
    (tmp_path / file).write_text("sensitivity 1000")
    before = _hash(record)
    (tmp_path / file).write_text("sensitivity 2000")
    assert (_hash(record) != before) == counts


def test_what_structures_are_taken_for_is_a_warning_of_the_study_that_asks_nothing_before_a_run(
    tmp_path: Path,
) -> None:
    sizes = "height_m: 2.2, thickness_m: 0.3"
    entries = "".join(f"- {{name: w{number}, type: wall, {sizes}}}\n" for number in range(10))
    free = f"- {{name: boundary, type: free_wall, {sizes}}}\n- {{name: top, type: pinnacle, {sizes}}}\n"
    plan = make_plan(_write(tmp_path, f"a,a.AT2,{SHA256}\n", entries + free))
    told = study_warnings(plan.settings, plan.scenes)
    assert [(warning.kind, warning.about) for warning in told] == [
        *((AssessmentKind.HELD_AT_CEILING, f"w{number}") for number in range(10)),
        (AssessmentKind.ON_STILL_BASE, "top"),
    ]
    assert plan.warnings == ()


@pytest.mark.parametrize(("ag", "told"), [(0.26, False), (0.6, False), (2.55, True)])
def test_a_design_level_typed_in_another_unit_gets_a_warning(tmp_path: Path, ag: float, told: bool) -> None:
    level = {"ag_g": ag, "f0": 2.4, "tc_star_s": 0.3}
    plan = make_plan(_write(tmp_path, f"a,a.AT2,{SHA256}\n", design_spectrum=level))
    warnings = plan.warnings
    said = "design_spectrum.ag_g is 2.55 g, but is usually between 0 and 0.6 g for a design level; check the unit."
    assert list(warnings) == [said] * told
