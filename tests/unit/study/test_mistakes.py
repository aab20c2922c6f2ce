"""What newcomers type by mistake: each is read as it was meant, or refused in one sentence that says what to do."""

import pickle
import subprocess
import sys
from dataclasses import fields
from pathlib import Path

import numpy as np
import pytest
import xlsxwriter

from rocking.assessment.conclusion import TO_CHECK
from rocking.assessment.scene import load_scenes
from rocking.catalogue import load_catalogue
from rocking.catalogue.station import open_station
from rocking.errors import CatalogueError, ConfigurationError, RecordError
from rocking.quantities import GRAVITY
from rocking.records import read
from rocking.structures.kinds import StructureKind
from rocking.study import run
from rocking.study.cli import main
from rocking.study.outputs import STEPS
from rocking.study.own_files import Declared, read_files
from rocking.study.plan import _curves
from rocking.study.products import BY_NAME
from rocking.study.settings import Settings

STEP = 0.01
COUNT = 4.71e-6
"""m/s² of one count of a recorder."""
HEAD = "name,type,breadth_m,height_m"


@pytest.fixture
def counts(tmp_path: Path) -> Path:
    """A record of counts with a peak of 0.5 g."""
    samples = 0.5 * GRAVITY / COUNT * np.sin(2 * np.pi * STEP * np.arange(1001))
    path = tmp_path / "counts.txt"
    path.write_text("".join(f"{STEP * i:.2f} {sample:.0f}\n" for i, sample in enumerate(samples)))
    return path


@pytest.fixture
def study(tmp_path: Path) -> Path:
    folder = tmp_path / "study"
    assert main(["start", str(folder)]) == 0
    return folder


def refusal(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> str:
    """What a command says that is refused."""
    capsys.readouterr()
    assert main(arguments) in (1, 2)
    said = capsys.readouterr().err
    assert said.startswith("rocking: ") and said.count("\n") == 1
    return said


def test_counts_are_read_by_their_factor_or_by_the_unit_of_one(counts: Path) -> None:
    with pytest.raises(RecordError, match=r"as in 4\.71e-6 m/s2"):
        read(counts, unit="m/s2")
    by_unit = read_files([counts], Declared(unit=f"{COUNT} m/s2")).channels[counts]
    by_factor = read_files([counts], Declared(unit="m/s2", scale_factor=COUNT)).channels[counts]
    assert by_unit[0].peak_acceleration == pytest.approx(0.5 * GRAVITY, rel=1e-3)
    assert by_factor[0].scaled(COUNT).peak_acceleration == pytest.approx(0.5 * GRAVITY, rel=1e-3)


@pytest.mark.parametrize("cells", [f"{COUNT} m/s2,1", f"m/s2,{COUNT}"])
def test_a_catalogue_gives_the_factor_of_counts(counts: Path, cells: str) -> None:
    catalogue = counts.with_name("catalogue.csv")
    catalogue.write_text(f"id,file,unit,scale_factor\na,counts.txt,{cells}\n")
    (record,) = open_station(load_catalogue(catalogue)[0]).horizontal
    assert record.peak_acceleration == pytest.approx(0.5 * GRAVITY, rel=1e-3)
    assert not record.warnings


def test_a_factor_above_one_is_no_excuse_for_a_wrong_unit(counts: Path) -> None:
    with pytest.raises(RecordError, match="above the 5 g"):
        read_files([counts], Declared(unit="m/s2", scale_factor=2.0))


def test_a_command_is_told_of_its_scale_by_its_own_name(
    counts: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    assert "scale is 0" in refusal(["read", str(counts), "--scale", "0"], capsys)


@pytest.mark.parametrize("second", ["wall ", "Wall", "WALL", " wall"])
def test_names_that_look_alike_are_refused(tmp_path: Path, second: str) -> None:
    path = tmp_path / "list.yaml"
    block = "type: block, breadth_m: 1, height_m: 4"
    path.write_text(f"- {{name: wall, {block}}}\n- {{name: '{second}', {block}}}\n")
    with pytest.raises(ConfigurationError, match="'wall', but for blanks and capitals"):
        load_scenes(path)


def test_a_list_of_structures_may_be_a_workbook(tmp_path: Path) -> None:
    path = tmp_path / "structures.xlsx"
    book = xlsxwriter.Workbook(path)
    sheet = book.add_worksheet()
    for place, row in enumerate(([*HEAD.split(",")], ["a", "block", 1, 4.5], [], ["b", "block", 0.5, "3"])):
        sheet.write_row(place, 0, row)
    book.close()
    (tmp_path / "structures.csv").write_text(f"{HEAD}\na,block,1,4.5\nb,block,0.5,3\n")
    assert load_scenes(path) == load_scenes(tmp_path / "structures.csv")
    path.write_bytes(path.read_bytes()[:-200])
    with pytest.raises(ConfigurationError, match=r"save the sheet as CSV|UTF-8"):
        load_scenes(path)


@pytest.mark.parametrize("dash", ["-", "–", "—"])
def test_a_dash_is_an_empty_cell(tmp_path: Path, dash: str) -> None:
    path = tmp_path / "list.csv"
    path.write_text(f"{HEAD},restitution\na,block,1,4,{dash}\n", encoding="utf-8")
    given = load_scenes(path)
    path.write_text(f"{HEAD},restitution\na,block,1,4,\n")
    assert given == load_scenes(path)


def test_a_refusal_names_the_key_as_it_is_typed(tmp_path: Path) -> None:
    path = tmp_path / "list.yaml"
    path.write_text("- {name: a, type: wall, height_m: 3, thickness_m: 0.3, crack: known}\n")
    with pytest.raises(ConfigurationError, match=r"hinge_height_m is missing"):
        load_scenes(path)


@pytest.mark.parametrize(
    ("heights", "is_told"),
    [([3.5, 6.5, 9.5], True), ([3.5, 3.2, 3.0], False), ([4.0, 5.0], False), ([9.5], False)],
)
def test_levels_in_place_of_storey_heights_get_a_warning(
    tmp_path: Path, heights: list[float], is_told: bool
) -> None:
    path = tmp_path / "list.yaml"
    thicknesses = [0.6] * len(heights)
    sizes = f"storey_heights_m: {heights}, thicknesses_m: {thicknesses}, unit_weight_kN_m3: 18"
    path.write_text(f"- {{name: a, type: facade, {sizes}}}\n")
    warnings = load_scenes(path)["a"].warnings
    told = [warning for warning in warnings if warning.kind is StructureKind.LEVELS_TYPED]
    assert bool(told) == is_told
    if told:
        assert "19.5 m" in str(told[0])
        assert told[0].kind in TO_CHECK, "the terminal says it as well"


def test_the_catalogue_of_a_study_is_that_of_its_settings(study: Path, counts: Path) -> None:
    counts.rename(study / "records" / counts.name)
    assert main(["catalogue", str(study), "--unit", f"{COUNT} m/s2"]) == 0
    assert [path.name for path in study.rglob("catalogue.csv")] == ["catalogue.csv"]
    assert load_catalogue(study / "records" / "catalogue.csv")[0].file == "counts.txt"


def test_a_study_is_named_by_one_of_its_folders(study: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert f"rocking run {study}" in refusal(["run", str(study / "records")], capsys)
    assert f"rocking run {study}" in refusal(["run", str(study / "structures.yaml")], capsys)
    (study / "config.yaml").rename(study / "config.yml")
    assert "rename its config.yml" in refusal(["run", str(study)], capsys)


def test_a_table_without_names_above_its_columns_is_one_sentence(tmp_path: Path) -> None:
    path = tmp_path / "catalogue.csv"
    path.write_text("a,a.smc,,,,,,\nb,b.smc,,,,,,\n")
    with pytest.raises(CatalogueError, match=r"names no column; write .* as in id,file\.$"):
        load_catalogue(path)
    path = path.with_name("structures.csv")
    path.write_text("a,block,1,4\n")
    with pytest.raises(ConfigurationError, match="names no column"):
        load_scenes(path)


def test_empty_rows_and_columns_say_nothing(tmp_path: Path) -> None:
    path = tmp_path / "catalogue.csv"
    path.write_text("id,file,,\na,a.smc,,\n,,,\n,,,\n")
    assert [record.id for record in load_catalogue(path)] == ["a"]
    path.write_text("id,file,,\na,a.smc,,1\n")
    with pytest.raises(CatalogueError, match="more cells than there are columns"):
        load_catalogue(path)


def test_braces_that_the_shell_cut_are_named(counts: Path, capsys: pytest.CaptureFixture[str]) -> None:
    typed = ["{type:", "free_wall,", "height_m:", "3,", "thickness_m:", "0.4}"]
    with pytest.raises(SystemExit):
        main(["assess", str(counts), "--structures", *typed])
    assert "quotation marks" in capsys.readouterr().err


def test_a_size_that_a_structure_lacks_is_said_of_its_type_as_listed(
    study: Path, counts: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    counts.rename(study / "records" / counts.name)
    assert main(["catalogue", str(study), "--unit", f"{COUNT} m/s2"]) == 0
    (study / "structures.yaml").write_text("- {name: w, type: free_wall, height_m: 3, thickness_m: 0.4}\n")
    said = refusal(["strengthen", str(study), "w", "tie_strength_kN_m", "2..40"], capsys)
    assert "a free wall has no such size; it has" in said
    assert "did you mean thickness_m?" in refusal(
        ["strengthen", str(study), "w", "thickness", "0.2..1"], capsys
    )


@pytest.mark.parametrize(
    "options",
    [["-n"], ["-j", "2"], ["--forceall"], ["summary", "-n"], ["--", "--dry-run"], ["summary", "--", "-n"]],
)
def test_options_of_snakemake_are_taken_with_and_without_dashes_before_them(
    monkeypatch: pytest.MonkeyPatch, options: list[str]
) -> None:
    given: list[object] = []
    monkeypatch.setattr("rocking.study.run.run", lambda folder, taken: given.append((folder, taken)) or 0)
    assert main(["run", "study", *options]) == 0
    assert given == [(Path("study"), [option for option in options if option != "--"])]


def test_an_option_that_no_other_command_has_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        main(["read", "file", "-n"])
    assert "unrecognized arguments: -n" in capsys.readouterr().err


def test_checks_without_a_design_level_are_refused_before_a_record_is_computed(
    study: Path, counts: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    counts.rename(study / "records" / counts.name)
    assert main(["catalogue", str(study), "--unit", f"{COUNT} m/s2"]) == 0
    (study / "config.yaml").write_text("structures: structures.yaml\n")
    assert "checks need a design level" in refusal(["checks", str(study)], capsys)
    assert not (study / "results").exists()


@pytest.mark.parametrize("name", ["structures.yaml", "records/catalogue.csv"])
def test_a_link_to_itself_is_no_file(study: Path, name: str, capsys: pytest.CaptureFixture[str]) -> None:
    (study / "records" / "catalogue.csv").write_text("id,file\na,a.smc\n")
    (study / name).unlink()
    (study / name).symlink_to(Path(name).name)
    capsys.readouterr()
    assert main(["run", str(study)]) == 2
    assert "symbolic links" in capsys.readouterr().err


@pytest.mark.parametrize("protocol", range(pickle.HIGHEST_PROTOCOL + 1))
def test_a_pickle_is_called_one_and_obspy_is_not_advised(tmp_path: Path, protocol: int) -> None:
    path = tmp_path / "record.pickle"
    path.write_bytes(pickle.dumps({"samples": np.zeros(30)}, protocol=protocol))
    with pytest.raises(RecordError, match="pickled Python object") as caught:
        read(path)
    assert "obspy" not in str(caught.value)


@pytest.mark.process
def test_the_rules_of_a_study_are_those_of_a_study(study: Path, counts: Path) -> None:
    """The package has some thirty more, about its documentation and its research."""
    counts.rename(study / "records" / counts.name)
    assert main(["catalogue", str(study), "--unit", f"{COUNT} m/s2"]) == 0
    listed = subprocess.run(
        [sys.executable, "-m", "snakemake", "--list"], cwd=study, capture_output=True, text=True, check=True
    )
    assert set(listed.stdout.split()) == {"all", "results", *STEPS, "summary", *BY_NAME}


def test_a_study_without_snakemake_names_the_extra_that_has_it(
    study: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(run, "find_spec", lambda _name: None)
    extra = "pip install 'rocking[workflow]'"
    assert extra in refusal(["run", str(study)], capsys)
    assert extra in Path("README.md").read_text(encoding="utf-8")


def test_a_new_study_says_that_its_schemas_are_on_this_machine(study: Path) -> None:
    for name in ("config.yaml", "structures.yaml"):
        schema, note, *_ = (study / name).read_text(encoding="utf-8").splitlines()
        assert "$schema=file:" in schema and "remove it where the study is moved" in note
    assert not _curves(study / "structures.yaml"), (
        "no job reads the schema, which another machine has elsewhere"
    )


def test_a_study_without_reports_says_how_to_make_its_map() -> None:
    meaning = next(item.metadata for item in fields(Settings) if item.name == "reports")
    assert "without them a run makes no map, which rocking map then does" in str(meaning)
    assert [name for name, product in BY_NAME.items() if product.in_every_run(Settings(reports=False))] == []
