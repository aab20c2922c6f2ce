"""The plan of a study: what is refused, how records are shared out, what makes a job run again."""

import hashlib
import shutil
from pathlib import Path

import pytest
import yaml
from hypothesis import given
from hypothesis import strategies as st

from rocking.errors import ConfigurationError
from rocking.study import plan
from rocking.study.plan import make_plan, planned_records, share_out

ROOT = Path(__file__).parents[3]
SHA256 = "0" * 64


def _write(folder: Path, rows: str, structures: str = "", **settings: object) -> dict[str, object]:
    """Write a catalogue and a structure list into `folder` and return the settings that name them."""
    (folder / "catalogue.csv").write_text(f"id,file,sha256\n{rows}")
    block = "[{name: pier, type: block, breadth_m: 1, height_m: 6}]"
    (folder / "structures.yaml").write_text(structures or block)
    paths = {name: str(folder / name) for name in ("results", "catalogue.csv", "structures.yaml")}
    named = {"catalogue": paths["catalogue.csv"], "structures": paths["structures.yaml"]}
    return named | {"results": paths["results"]} | settings


def _refusal(settings: dict[str, object]) -> str:
    with pytest.raises(ConfigurationError) as caught:
        make_plan(settings)
    return str(caught.value)


def test_the_shipped_study_is_accepted() -> None:
    settings = yaml.safe_load((ROOT / "workflow" / "config.yaml").read_text(encoding="utf-8"))
    settings |= {name: str(ROOT / settings[name]) for name in ("catalogue", "structures", "results")}
    assert make_plan(settings).records


@pytest.mark.parametrize(
    "identifier",
    [
        "",
        "../up",
        "a/b",
        "/etc",
        "..",
        "a\\b",
        ".hidden",
        "-rf",
        "a b",
        "CON",
        "summary",
        "a" * 81,
        "naïve",
        "a\tb",
    ],
)
def test_an_id_that_is_no_safe_file_name_is_refused(tmp_path: Path, identifier: str) -> None:
    message = _refusal(_write(tmp_path, f'"{identifier}",a.AT2,{SHA256}\n'))
    assert repr(identifier)[1:-1] in message and "safe file name" in message


@pytest.mark.parametrize("file", ["../up.AT2", "/etc/passwd", "a/../../b", "C:\\a"])
def test_a_file_outside_the_catalogue_folder_is_refused(tmp_path: Path, file: str) -> None:
    assert "relative path without '..'" in _refusal(_write(tmp_path, f"a,{file},{SHA256}\n"))


def test_duplicate_ids_are_refused_whatever_their_case(tmp_path: Path) -> None:
    message = _refusal(_write(tmp_path, f"Rinaldi,a.AT2,{SHA256}\nrinaldi,b.AT2,{SHA256}\n"))
    assert "'rinaldi' stands 2 times" in message


def test_a_catalogue_without_rows_is_refused(tmp_path: Path) -> None:
    assert "no rows" in _refusal(_write(tmp_path, ""))


def test_a_hash_that_is_none_is_refused(tmp_path: Path) -> None:
    assert "sha256 is 'abc'" in _refusal(_write(tmp_path, "a,a.AT2,abc\n"))


def test_a_blank_hash_is_filled_in_and_checked_from_then_on(tmp_path: Path) -> None:
    (tmp_path / "a.AT2").write_bytes(b"one")
    settings = _write(tmp_path, "a,a.AT2,\nb,b.AT2,\n")
    before = Path(str(settings["catalogue"])).read_bytes()
    first = make_plan(settings)
    assert Path(str(settings["catalogue"])).read_bytes() == before, "a plan alone writes nothing"
    assert first.records["a"].sha256 == hashlib.sha256(b"one").hexdigest() and first.records["b"].sha256 == ""
    first.begin()
    (job,) = first.jobs
    planned_records(Path(str(settings["catalogue"])), first.jobs[job], first.records_sha256(job))
    (tmp_path / "a.AT2").write_bytes(b"two")
    assert make_plan(settings).records["a"].sha256 == first.records["a"].sha256


def test_all_defects_of_all_three_files_stand_in_one_message(tmp_path: Path) -> None:
    structures = "[{name: pier, type: block, breadth_m: 1, hieght_m: 6}, {name: pier, type: blok}]"
    settings = _write(tmp_path, f"a/b,a.AT2,{SHA256}\nc,../c,1\n", structures, tolerance=5, tolerence=1e-6)
    message = _refusal(settings)
    for defect in ("'a/b'", "'../c'", "hieght_m", "height_m", "'blok'", "setting tolerance", "tolerence"):
        assert defect in message


def test_files_are_looked_for_where_a_defective_config_names_them(tmp_path: Path) -> None:
    settings = _write(tmp_path, "", tolerance=5, catalogue=str(tmp_path / "elsewhere.csv"))
    assert "elsewhere.csv" in _refusal(settings) and "records/catalogue.csv" not in _refusal(settings)


def test_results_that_cannot_be_a_folder_are_refused(tmp_path: Path) -> None:
    (tmp_path / "taken").write_text("")
    settings = _write(tmp_path, f"a,a.AT2,{SHA256}\n", results=str(tmp_path / "taken" / "results"))
    assert "taken is a file, but must be a folder" in _refusal(settings)


def test_results_that_cannot_be_written_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Root may write everywhere, so the answer of the system is played, not made."""
    monkeypatch.setattr(plan.os, "access", lambda path, mode: False)
    message = _refusal(_write(tmp_path, f"a,a.AT2,{SHA256}\n"))
    assert f"nothing can be written in {tmp_path}" in message


def test_structures_are_read_as_data_only(tmp_path: Path) -> None:
    structures = f"!!python/object/apply:os.mkdir ['{tmp_path / 'made'}']"
    assert "not valid YAML" in _refusal(_write(tmp_path, f"a,a.AT2,{SHA256}\n", structures))
    assert not (tmp_path / "made").exists()


def test_a_catalogue_edited_after_planning_stops_the_job(tmp_path: Path) -> None:
    settings = _write(tmp_path, f"a,a.AT2,{SHA256}\nb,b.AT2,{SHA256}\n", records_per_job=10)
    made = make_plan(settings)
    (job,) = made.jobs
    catalogue = Path(str(settings["catalogue"]))
    assert planned_records(catalogue, made.jobs[job], made.records_sha256(job)) == made.job(job)
    assert planned_records(catalogue, None, made.records_sha256()) == tuple(made.records.values())
    catalogue.write_text(catalogue.read_text().replace(SHA256, "1" * 64, 1))
    with pytest.raises(ConfigurationError, match="changed while the study ran"):
        planned_records(catalogue, made.jobs[job], made.records_sha256(job))
    with pytest.raises(ConfigurationError, match="changed while the study ran"):
        planned_records(catalogue, None, made.records_sha256())


def test_what_changes_no_number_does_not_change_the_hash_of_the_settings(tmp_path: Path) -> None:
    settings = _write(tmp_path, f"a,a.AT2,{SHA256}\n")
    hashes = {
        make_plan(settings | changed).settings_sha256
        for changed in (
            {},
            {"reports": False},
            {"results": str(tmp_path / "elsewhere")},
            {"records_per_job": 7},
        )
    }
    assert len(hashes) == 1
    assert make_plan(settings | {"tolerance": 1e-7}).settings_sha256 not in hashes


def test_the_hash_of_the_package_follows_its_source(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    shutil.copytree(ROOT / "rocking", tmp_path / "rocking", ignore=shutil.ignore_patterns("__pycache__"))
    monkeypatch.setattr(plan, "__file__", str(tmp_path / "rocking" / "study" / "plan.py"))
    whole, without = plan.package_sha256(), plan.package_sha256(leave_out=("reports",))
    with (tmp_path / "rocking" / "reports" / "record" / "record.typ").open("a") as stream:
        stream.write("// edited\n")
    assert plan.package_sha256() != whole
    assert plan.package_sha256(leave_out=("reports",)) == without
    (tmp_path / "rocking" / "quantities.py").rename(tmp_path / "rocking" / "measures.py")
    assert plan.package_sha256(leave_out=("reports",)) != without


@given(
    st.sets(st.text("abcdef0123456789", min_size=1, max_size=8), min_size=1, max_size=400),
    st.none() | st.integers(1, 50),
)
def test_every_record_is_in_one_job(identifiers: set[str], size: int | None) -> None:
    jobs = share_out(sorted(identifiers), size)
    shared = [identifier for job in jobs.values() for identifier in job]
    assert sorted(shared) == sorted(identifiers)
    assert all(job == tuple(sorted(job)) for job in jobs.values())


@pytest.mark.parametrize("number", [20, 100, 700, 3000])
def test_a_record_more_changes_one_job(number: int) -> None:
    before = share_out([f"record_{i}" for i in range(number)])
    after = share_out([f"record_{i}" for i in range(number + 1)])
    assert len(set(after.items()) - set(before.items())) == 1


def test_jobs_are_few_and_their_number_never_falls() -> None:
    counts = [len(share_out([f"record_{i}" for i in range(n)])) for n in (1, 2, 8, 60, 1000, 2000, 20000)]
    assert counts == sorted(counts)
    assert counts[3:6] == [8, 8, 16], "sixty records start as many as most machines have cores"
    largest = max(map(len, share_out([f"record_{i}" for i in range(20000)]).values()))
    assert largest < 230, "twenty thousand lose less than a minute with a job"
