"""The plan of a study: what is refused, how records are shared out, what makes a job run again."""

import hashlib
import os
import shutil
import time
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from rocking.assessment.kinds import AssessmentKind
from rocking.catalogue import CatalogueRecord
from rocking.errors import ConfigurationError
from rocking.structures.kinds import StructureKind
from rocking.study import contents as contents_module
from rocking.study import settings as settings_module
from rocking.study.contents import ContentHashes
from rocking.study.job import begin_job, prepare
from rocking.study.made_from import made_from
from rocking.study.plan import Plan, batches_of, make_plan, plan_of_job, study_remarks
from rocking.study.settings import Settings, read_settings, settings_sha256
from rocking.study.task import Task
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
    prepare(read_settings(settings))
    wall = plan_of_job(settings, "record/a").scenes["wall"].structure
    assert wall.__dict__["_candidates"], "it keeps its cracks"
    assert plan_of_job(settings, "record/a").scenes["wall"].structure is wall
    listed = tmp_path / "structures.yaml"
    listed.write_text(listed.read_text().replace("0.25", "0.35"))
    assert plan_of_job(settings, "record/a").scenes["wall"].structure.thickness == 0.35  # type: ignore[attr-defined]
    prepare(read_settings(settings | {"structures": str(tmp_path / "none.yaml")}))  # its jobs tell


def _refusal(settings: dict[str, object]) -> str:
    with pytest.raises(ConfigurationError) as caught:
        make_plan(settings)
    return str(caught.value)


@pytest.mark.process
def test_a_blank_hash_is_filled_in_and_checked_from_then_on(tmp_path: Path) -> None:
    (tmp_path / "a.AT2").write_bytes(b"one")
    settings = _write(tmp_path, "a,a.AT2,\nb,b.AT2,\n")
    before = Path(str(settings["catalogue"])).read_bytes()
    first = make_plan(settings)
    assert Path(str(settings["catalogue"])).read_bytes() == before, "a plan alone writes nothing"
    assert first.records["a"].sha256 == hashlib.sha256(b"one").hexdigest() and first.records["b"].sha256 == ""
    planned = made_from("record/a", first)
    first.fill_hashes()
    assert made_from("record/a", make_plan(settings)) == planned, "what was planned before holds after"
    (tmp_path / "a.AT2").write_bytes(b"two")
    assert make_plan(settings).records["a"].sha256 == first.records["a"].sha256


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


@pytest.mark.process
@pytest.mark.parametrize(
    ("name", "old", "new"),
    [("catalogue", SHA256, "1" * 64), ("structures", "height_m: 6", "height_m: 7")],
)
def test_what_was_edited_after_planning_stops_the_job(tmp_path: Path, name: str, old: str, new: str) -> None:
    settings = _write(tmp_path, f"a,a.AT2,{SHA256}\nb,b.AT2,{SHA256}\n", records_per_job=10)
    (batch,) = make_plan(settings).batches
    product = f"batch/{batch}"
    task = Task(product, settings, made_from(product, make_plan(settings)))
    path = Path(str(settings[name]))
    path.write_text("\n# a comment\n" * (name == "structures") + path.read_text())
    with refused(ConfigurationError, "made_from", name), begin_job(task) as job:
        assert [record.id for record in job.records] == ["a", "b"]
        path.write_text(path.read_text().replace(old, new, 1))
    with refused(ConfigurationError, "made_from", name), begin_job(task):
        pytest.fail("it begins")
    if name == "catalogue":
        (tmp_path / "catalogue.csv").write_text("id,file,sha256\nb,b.AT2,\n")
        gone = Task("record/a", settings, ())
        with refused(ConfigurationError, "record", "a"), begin_job(gone):
            pytest.fail("it begins")


def test_what_changes_no_number_does_not_change_the_hash_of_the_settings(tmp_path: Path) -> None:
    settings = _write(tmp_path, f"a,a.AT2,{SHA256}\n")
    changes = ({}, {"reports": False}, {"results": str(tmp_path / "elsewhere")}, {"records_per_job": 7})

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


@given(
    st.sets(st.text("abcdef0123456789", min_size=1, max_size=8), min_size=1, max_size=400),
    st.none() | st.integers(1, 50),
)
def test_every_record_is_in_one_batch(identifiers: set[str], size: int | None) -> None:
    batches = batches_of(sorted(identifiers), size)
    shared = [identifier for batch in batches.values() for identifier in batch]
    assert sorted(shared) == sorted(identifiers)
    assert all(batch == tuple(sorted(batch)) for batch in batches.values())


@pytest.mark.parametrize(
    ("number", "size", "batches"),
    [
        (24, None, 1), (25, None, 2), (193, None, 8), (1600, None, 8), (1601, None, 16), (100_000, None, 512),
        (100, 25, 4), (101, 25, 8),
    ],
)  # fmt: skip
def test_records_are_shared_out_to_a_power_of_two_by_the_hash_of_each(number, size, batches) -> None:
    """The setting says: 24; of many an eighth, at most 200."""
    names = [f"r{place}" for place in range(number)]
    shared = batches_of(names, size)
    assert {name.partition("_of_")[2] for name in shared} == {f"{batches:05d}"}
    for name in names[:3]:
        place = int(hashlib.sha256(name.encode()).hexdigest()[:8], 16) % batches
        assert name in shared[f"{place:05d}_of_{batches:05d}"]


@pytest.mark.parametrize("number", [20, 100, 700, 3000])
def test_a_record_more_changes_one_batch(number: int) -> None:
    before = batches_of([f"record_{i}" for i in range(number)])
    after = batches_of([f"record_{i}" for i in range(number + 1)])
    assert len(set(after.items()) - set(before.items())) == 1


COUNTS = b"000001D " + bytes(504)
"""What a miniSEED file begins with."""


def _record(folder: Path, content: bytes = b"samples", **cells: object) -> CatalogueRecord:
    (folder / "a.dat").write_bytes(content)
    return CatalogueRecord(**{"id": "a", "file": "a.dat", "sha256": "0" * 64} | cells, folder=folder)


def _hash(record: CatalogueRecord, hashes: ContentHashes | None = None, **settings: object) -> str:
    made = hashes or ContentHashes(Path("nowhere"))
    return repr(Plan(Settings(**settings), {"a": record}, {}, made).files_of(record))


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


def test_a_file_that_stayed_is_not_read_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    record, store = _record(tmp_path), tmp_path / "hashes.json"
    for settled in (contents_module._SETTLED, -1.0):
        assert not store.exists(), "what changed a moment ago may change again"
        monkeypatch.setattr(contents_module, "_SETTLED", settled)
        hashes = ContentHashes(store)
        first = _hash(record, hashes)
        hashes.save()
    with monkeypatch.context() as patched:
        patched.setattr(hashlib, "file_digest", lambda *_: pytest.fail("it is read again"))
        assert _hash(record, ContentHashes(store)) == first
    status = (tmp_path / "a.dat").stat()
    (tmp_path / "a.dat").write_bytes(b"Samples")
    os.utime(tmp_path / "a.dat", ns=(status.st_atime_ns, status.st_mtime_ns))
    assert _hash(record, ContentHashes(store)) == _hash(record) != first
    store.write_text('{"damaged": 1}')
    assert _hash(record, ContentHashes(store)) == _hash(record)


def test_an_edit_of_the_reports_is_in_the_hash_of_the_package_and_not_in_that_of_its_numbers(
    tmp_path, monkeypatch
):
    for name in ("reports/page.py", "motion/table.py", "study/settings.py"):
        path = tmp_path / name
        path.parent.mkdir()
        path.write_text("1\n")
    monkeypatch.setattr(settings_module, "__file__", str(tmp_path / "study" / "settings.py"))

    def hashes() -> tuple[str, str]:
        hash_of = settings_module.package_sha256.__wrapped__
        return hash_of(), hash_of(reports=False)

    before = hashes()
    (tmp_path / "reports" / "page.py").write_text("2\n")
    after = hashes()
    assert after[0] != before[0] and after[1] == before[1]

    (tmp_path / "motion" / "table.py").write_text("2\n")
    assert hashes()[0] != after[0] and hashes()[1] != after[1]


def test_what_walls_are_taken_for_is_a_remark_of_the_study_that_asks_nothing_before_a_run(
    tmp_path: Path,
) -> None:
    sizes = "height_m: 2.2, thickness_m: 0.3"
    entries = "".join(f"- {{name: w{number}, type: wall, {sizes}}}\n" for number in range(10))
    free = f"- {{name: boundary, type: free_wall, {sizes}}}\n"
    plan = make_plan(_write(tmp_path, f"a,a.AT2,{SHA256}\n", entries + free))
    told = study_remarks(plan.settings, plan.scenes)
    assert [(each.kind, each.about) for each in told] == [
        (AssessmentKind.HELD_AT_CEILING, f"w{number}") for number in range(10)
    ]
    assert plan.doubts == ()


@pytest.mark.parametrize(("ag", "told"), [(0.26, False), (0.6, False), (2.55, True)])
def test_a_design_level_typed_in_another_unit_gets_a_remark(tmp_path: Path, ag: float, told: bool) -> None:
    level = {"ag_g": ag, "f0": 2.4, "tc_star_s": 0.3}
    plan = make_plan(_write(tmp_path, f"a,a.AT2,{SHA256}\n", design_spectrum=level))
    remarks = [str(remark) for remark in plan.doubts if remark.kind is StructureKind.SIZE_UNUSUAL]
    said = "design_spectrum.ag_g is 2.55 g, but is usually between 0 and 0.6 g for a design level; check the unit."
    assert remarks == [said] * told
