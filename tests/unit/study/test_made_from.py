"""What each edit of a study computes again: a table written by hand, asked of the seals of a study that is finished."""

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
import yaml

from rocking.errors import ConfigurationError
from rocking.records.synthetic import SyntheticRecord, at2_text
from rocking.study import made_from
from rocking.study.made_from import TABLE
from rocking.study.plan import Plan, make_plan, plan_of_job
from rocking.study.seals import Seals
from rocking.study.settings import StudyDesign
from rocking.study.workspace import write_catalogue

STRUCTURES = [
    {"name": "block", "type": "block", "breadth_m": 0.5, "height_m": 3.0},
    {"name": "wall", "type": "wall", "height_m": 3.2, "hinge_height_m": 1.6, "thickness_m": 0.25},
]
SETTINGS = {
    "design_spectrum": {"points": "design.csv", "pool": "pool/catalogue.csv"},
    "fragility": {"hazard": "hazard.csv", "in_every_run": True},
    "trade": {"in_summary": True},
}
RECORDS = ("R/a", "R/b")
NUMBERS = "a b B S C F T"
"""What depends on every number: both records, the batch of both, summary, checks, fragility and trade."""
PRODUCTS = {
    "a": "records/a",
    "b": "records/b",
    "B": "batches/00000_of_00001",
    "S": "summary",
    "C": "checks",
    "F": "fragility",
    "T": "trade",
}


def _waves(seed: int) -> bytes:
    return at2_text(SyntheticRecord("made", seed, 1.0, 0.3, 1.0, 0.5, 2.0, 0.01)).encode()


def _write_settings(**changed: object) -> None:
    settings: dict[str, object] = {**SETTINGS}
    for name, value in changed.items():
        section = settings.get(name)
        both = isinstance(section, dict) and isinstance(value, dict)
        settings[name] = {**section, **value} if both else value
    Path("config.yaml").write_text(yaml.safe_dump(settings))


def _write_catalogue(folder: str, *names: str, **cells: str) -> None:
    columns = ["id", "file", "unit", *cells]
    lines = [",".join(columns), *(",".join([name, f"{name}.AT2", "g", *cells.values()]) for name in names)]
    Path(folder, "catalogue.csv").write_text("\n".join([*lines, ""]))


def _plan() -> Plan:
    return make_plan(yaml.safe_load(Path("config.yaml").read_text()))


@pytest.fixture(scope="module")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A study whose products all stand: of each a file, and its seal."""
    folder = tmp_path_factory.mktemp("finished")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        _write_study()
    return folder


@pytest.fixture
def study(finished: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of it in which the test runs."""
    monkeypatch.chdir(shutil.copytree(finished, tmp_path / "study"))
    return tmp_path / "study"


def _write_study() -> None:
    for folder, names in (("records", "ab"), ("pool", "p")):
        Path(folder).mkdir()
        for name in names:
            Path(folder, f"{name}.AT2").write_bytes(_waves(ord(name)))
        _write_catalogue(folder, *names)
    Path("structures.yaml").write_text(yaml.safe_dump(STRUCTURES))
    Path("design.csv").write_text("period_s,acceleration_g\n0,0.2\n0.1,0.5\n0.5,0.5\n4,0.06\n")
    Path("hazard.csv").write_text("intensity,annual_rate\n0.1,0.01\n1,0.0001\n")
    _write_settings()
    _finish()


def _finish() -> None:
    """Write a file of each product, and its seal."""
    plan = _plan()
    for product in PRODUCTS.values():
        file = Path("results", f"{product.replace('/', '_')}.csv")
        file.parent.mkdir(exist_ok=True)
        file.write_text(f"{product}\n")
        plan.seals.write(product, plan.seals.key(product), [file])


def _again() -> str:
    """The products that stand and whose seals do not hold; one of a record that left is no product any more."""
    plan = _plan()
    stands = {
        letter: product
        for letter, product in PRODUCTS.items()
        if letter not in "ab" or letter in plan.records
    }
    return " ".join(letter for letter, product in stands.items() if plan.seals.why_again(product))


def _setting(**changed: object) -> Callable[[], None]:
    return lambda: _write_settings(**changed)


def _section(name: str, **changed: object) -> Callable[[], None]:
    return lambda: _write_settings(**{name: changed})


def _structures(*listed: dict[str, object]) -> Callable[[], None]:
    return lambda: Path("structures.yaml").write_text(yaml.safe_dump(list(listed))) and None


def _content(file: str, old: str, new: str) -> Callable[[], None]:
    def edit() -> None:
        path = Path(file)
        before = path.read_text()
        assert old in before
        path.write_text(before.replace(old, new, 1))

    return edit


def _bytes(file: str, content: bytes) -> Callable[[], None]:
    return lambda: Path(file).write_bytes(content) and None


def _cut(product: str) -> Callable[[], None]:
    """The last byte of a product goes, and its date is put back."""

    def edit() -> None:
        path = Path("results", f"{PRODUCTS[product].replace('/', '_')}.csv")
        status = path.stat()
        path.write_bytes(path.read_bytes()[:-1])
        os.utime(path, ns=(status.st_atime_ns, status.st_mtime_ns))

    return edit


def _seal(product: str, content: str | None) -> Callable[[], None]:
    path = Path("results", ".made_from", f"{PRODUCTS[product]}.json")
    return lambda: path.unlink() if content is None else path.write_text(content) and None


def _move_catalogue() -> None:
    shutil.copytree("records", "moved")
    _write_settings(catalogue="moved/catalogue.csv")


def _move_structures() -> None:
    shutil.copy("structures.yaml", "list.yaml")
    _write_settings(structures="list.yaml")


def _structures_as_csv() -> None:
    keys = list({key: None for each in STRUCTURES for key in each})
    lines = [keys, *([str(each.get(key, "")) for key in keys] for each in STRUCTURES)]
    Path("list.csv").write_text("\n".join(map(",".join, lines)))
    _write_settings(structures="list.csv")


def _cell_of_the_csv() -> None:
    _structures_as_csv()
    _finish()
    _content("list.csv", "3.2", "3.3")()


def _station_xml() -> None:
    """Of both records, which name it."""
    Path("records/station.xml").write_text("<a/>")
    _write_catalogue("records", "a", "b", inventory="station.xml")
    _finish()
    Path("records/station.xml").write_text("<b/>")


def _add_record() -> None:
    shutil.copy("pool/p.AT2", "records")
    _write_catalogue("records", "a", "b", "p")


BLOCK, WALL = STRUCTURES
EDITS: list[tuple[str, Callable[[], object], str]] = [
    ("nothing", lambda: None, ""),
    # What is told of the study stands in the report of a record, in the summary and on the pages to sign.
    ("study", _setting(study="A town"), "a b S C"),
    ("client", _setting(client="A town"), "a b S C"),
    ("project_number", _setting(project_number="12"), "a b S C"),
    ("author", _setting(author="Somebody"), "a b S C"),
    ("date", _setting(date="1 May"), "a b S C"),
    ("display_units", _setting(display_units="g and cm"), "a b S C"),
    ("details", _setting(details=True), "a b"),
    ("figures", _setting(figures="svg"), "a b S C F T"),
    ("language", _setting(language="it"), "S C"),
    # Where files lie changes nothing; what lies there does.
    ("mirror", _setting(mirror="elsewhere"), ""),
    ("catalogue elsewhere", _move_catalogue, NUMBERS),
    ("structures elsewhere", _move_structures, ""),
    ("structures as CSV", _structures_as_csv, ""),
    ("cell of the structures as CSV", _cell_of_the_csv, NUMBERS),
    ("records_per_job", _setting(records_per_job=5), "S"),
    # What else is written, and when.
    ("reports", _setting(reports=False), "a b B S"),
    ("histories", _setting(histories=True), "a b B S"),
    ("fragility.in_every_run", _section("fragility", in_every_run=False), "S"),
    ("trade.in_summary", _section("trade", in_summary=False), "S"),
    # Numbers.
    ("tolerance", _setting(tolerance=1e-7), NUMBERS),
    ("acceleration_scale", _setting(acceleration_scale="uplift"), NUMBERS),
    ("fidelity", _setting(fidelity="auto"), NUMBERS),
    ("fidelity_risk", _setting(fidelity_risk=0.02), NUMBERS),
    ("friction_coefficient", _setting(friction_coefficient=0.5), NUMBERS),
    ("scale_to", _setting(scale_to="pga 0.3 g"), NUMBERS),
    ("vertical", _setting(vertical=True), NUMBERS),
    ("candidates", _setting(candidates=3), NUMBERS),
    ("processing_variants", _setting(processing_variants=False), NUMBERS),
    ("processing.apply", _section("processing", apply="always"), NUMBERS),
    ("processing.pre_event_s", _section("processing", pre_event_s=0.5), NUMBERS),
    ("processing.baseline", _section("processing", baseline="none"), NUMBERS),
    ("processing.taper", _section("processing", taper=0.05), NUMBERS),
    ("processing.high_pass_Hz", _section("processing", high_pass_hz=0.2), NUMBERS),
    ("processing.low_pass_Hz", _section("processing", low_pass_hz=25), NUMBERS),
    ("processing.order", _section("processing", order=2), NUMBERS),
    ("processing.padding", _section("processing", padding=False), NUMBERS),
    ("processing.keep_padding", _section("processing", keep_padding=True), NUMBERS),
    ("processing.time_step_s", _section("processing", time_step_s=0.005), NUMBERS),
    ("pulse.lowest_frequency_Hz", _section("pulse", lowest_frequency_hz=0.2), NUMBERS),
    ("pulse.highest_frequency_Hz", _section("pulse", highest_frequency_hz=4), NUMBERS),
    ("pulse.frequencies_per_octave", _section("pulse", frequencies_per_octave=12), NUMBERS),
    ("pulse.candidates", _section("pulse", candidates=5), NUMBERS),
    ("pulse.alternatives", _section("pulse", alternatives=3), NUMBERS),
    ("pulse.pursuit", _section("pulse", pursuit=2), NUMBERS),
    ("pulse.overlap", _section("pulse", overlap=0.6), NUMBERS),
    ("pulse.samples_per_cycle", _section("pulse", samples_per_cycle=10), NUMBERS),
    ("pulse.choice", _section("pulse", choice="demand"), NUMBERS),
    ("ensemble.members", _section("ensemble", members=16), NUMBERS),
    ("ensemble.amplitude_range", _section("ensemble", amplitude_range=0.1), NUMBERS),
    ("ensemble.restitution_range", _section("ensemble", restitution_range=0.1), NUMBERS),
    ("ensemble.polarity", _section("ensemble", polarity=False), NUMBERS),
    ("ensemble.processing", _section("ensemble", processing=False), NUMBERS),
    ("ensemble.risk", _section("ensemble", risk=0.1), NUMBERS),
    ("ensemble.reserve", _section("ensemble", reserve=2.0), NUMBERS),
    # The design level is drawn in reports; what only the checks use is theirs.
    ("design level", _section("design_spectrum", points=None, ag_g=0.2, f0=2.5, tc_star_s=0.4), "a b S C"),
    ("design_spectrum.damping", _section("design_spectrum", damping=0.1), "a b S C"),
    ("design_spectrum.limit_state", _section("design_spectrum", limit_state="SLC"), "S C"),
    ("design_spectrum.confidence_factor", _section("design_spectrum", confidence_factor=1.2), "S C"),
    ("design_spectrum.behaviour_factor", _section("design_spectrum", behaviour_factor=1.5), "S C"),
    ("design_spectrum.stations", _section("design_spectrum", stations=10), "S C"),
    ("design_spectrum.least_factor", _section("design_spectrum", least_factor=0.3), "S C"),
    ("design_spectrum.largest_factor", _section("design_spectrum", largest_factor=3.0), "S C"),
    ("design_spectrum.shortest_period_s", _section("design_spectrum", shortest_period_s=0.2), "S C"),
    ("design_spectrum.longest_period_s", _section("design_spectrum", longest_period_s=1.5), "S C"),
    ("design_spectrum.seed", _section("design_spectrum", seed=1), "S C"),
    ("design_spectrum.pool", _section("design_spectrum", pool=None), "S C"),
    ("content of design.csv", _content("design.csv", "0.06", "0.05"), "a b S C"),
    ("content of a record of the pool", _bytes("pool/p.AT2", _waves(9)), "S C"),
    ("catalogue of the pool", lambda: _write_catalogue("pool", "p", scale_factor="2"), "S C"),
    ("record of the pool away", lambda: Path("pool/p.AT2").unlink(), "S C"),
    # The checks, the fragility and the trade stand in the summary.
    ("fragility.intensity_measure", _section("fragility", intensity_measure="pga"), "S F"),
    ("fragility.members", _section("fragility", members=False), "S F"),
    ("fragility.largest_factor", _section("fragility", largest_factor=5.0), "S F"),
    ("fragility.hazard", _section("fragility", hazard=None), "S F"),
    ("content of hazard.csv", _content("hazard.csv", "0.0001", "0.0002"), "S F"),
    # Records and their files.
    ("content of a record", _bytes("records/a.AT2", _waves(9)), "a B S C F T"),
    ("a byte of a record", lambda: _bytes("records/a.AT2", _waves(97) + b"\n")(), "a B S C F T"),
    ("date of a record", lambda: os.utime("records/a.AT2", (1e9, 1e9)), ""),
    ("record away", lambda: Path("records/a.AT2").unlink(), "a B S C F T"),
    ("cell of the catalogue", lambda: _write_catalogue("records", "a", "b", scale_factor="2"), NUMBERS),
    ("blank cells of the catalogue", lambda: _write_catalogue("records", "a", "b", event=""), ""),
    ("records in another order", lambda: _write_catalogue("records", "b", "a"), "B S C F T"),
    ("record renamed", _content("records/catalogue.csv", "b,b.AT2", "c,b.AT2"), "B S C F T"),
    ("StationXML of the records", _station_xml, NUMBERS),
    ("record less", lambda: _write_catalogue("records", "a"), "B S C F T"),
    ("record more", _add_record, "B S C F T"),
    # Structures.
    ("structure changed", _structures(BLOCK | {"height_m": 3.1}, WALL), NUMBERS),
    ("structure renamed", _structures(BLOCK | {"name": "pier"}, WALL), NUMBERS),
    ("structure added", _structures(BLOCK, WALL, BLOCK | {"name": "pier"}), NUMBERS),
    ("structure less", _structures(BLOCK), NUMBERS),
    ("structures in another order", _structures(WALL, BLOCK), NUMBERS),
    ("comment in the list", lambda: _content("structures.yaml", "- ", "# old\n- ")(), ""),
    ("terms of the checks", _structures(BLOCK | {"elastic_period_s": 0.3}, WALL), "S C"),
    # What was written, and what was remembered.
    *((f"{product} cut", _cut(product), product) for product in PRODUCTS),
    ("summary's seal away", _seal("S", None), "S"),
    ("record's seal cut", _seal("a", "{"), "a"),
    ("checks' seal no seal", _seal("C", "[1]"), "C"),
    ("all memory of the scheduler away", lambda: shutil.rmtree(".snakemake", ignore_errors=True), ""),
]


@pytest.mark.parametrize(("edit", "again"), [each[1:] for each in EDITS], ids=[each[0] for each in EDITS])
def test_each_edit_makes_again_what_depends_on_it_and_nothing_else(study, edit, again) -> None:
    edit()
    assert _again() == again
    assert _again() == again, "to ask changes nothing"


def test_every_setting_stands_in_the_table_of_edits() -> None:
    """But the places, and the design level, which has a line of its own."""
    settings = made_from.Settings()
    others = {
        "catalogue",
        "structures",
        "results",
    }
    others |= {f"design_spectrum.{name}" for name in StudyDesign.LEVEL}
    edits = [each[0] for each in EDITS]
    missing = [
        name
        for name in settings.told_in(list(vars(settings)))
        if name not in others and not any(edit.startswith(name) for edit in edits)
    ]
    assert missing == []


@pytest.mark.parametrize("library", ["numpy", "python", "matplotlib"])
def test_another_version_of_a_library_makes_everything_again(study, monkeypatch, library: str) -> None:
    versions = made_from.versions()
    monkeypatch.setattr(made_from, "versions", lambda: versions | {library: "0.1"})
    assert _again() == " ".join(PRODUCTS)


def test_an_edited_answer_makes_again_the_record_that_it_reads(study) -> None:
    """The table of layouts is no file of a record; the one answer by which its table is read is part of its content."""
    rows = "".join(f"{place / 100},{(-1) ** place}\n" for place in range(300))
    Path("records/b.AT2").write_text(f"Station 1\nTime,Q1\n{rows}")
    told = write_catalogue(Path("records"), Path("records/catalogue.csv"), None, None)
    answers = Path("records/layouts.csv")
    assert "Answer what stands in records/layouts.csv" in told and answers.read_text().count("t, ?") == 1
    answers.write_text(answers.read_text().replace("t, ?", "t, a g"))
    _finish()
    assert _again() == ""
    answers.write_text(answers.read_text() + '"one series g, dt 0.01","bare",x.txt,,1,,elsewhere\n')
    assert _again() == ""
    answers.write_text(answers.read_text().replace("t, a g", "t, NS g"))
    assert _again() == "b B S C F T"


def test_a_copied_folder_makes_nothing_again(study, monkeypatch, tmp_path) -> None:
    """Inodes and dates differ; contents do not."""
    shutil.copytree(study, study.parent / "copy")
    monkeypatch.chdir(study.parent / "copy")
    assert _again() == ""


def test_a_setting_is_edited_and_edited_back(study) -> None:
    _write_settings(tolerance=1e-7)
    assert _again() == NUMBERS
    _write_settings()
    assert _again() == ""


def test_why_is_told_in_words(study) -> None:
    Path("hazard.csv").write_text("intensity,annual_rate\n0.1,0.02\n1,0.0001\n")
    _write_settings(study="A town")
    seals = _plan().seals
    assert seals.why_again("fragility") == "changed: hazard.csv"
    assert seals.why_again("checks") == "changed: setting study"
    _write_settings()
    Path("results/checks.csv").write_text("edited\n")
    assert _plan().seals.why_again("checks") == "results/checks.csv is not as it was written"
    Path("results/checks.csv").unlink()
    assert _plan().seals.why_again("checks") == "results/checks.csv is not there any more"


def test_a_job_whose_files_changed_while_it_worked_seals_nothing(study) -> None:
    plan = plan_of_job(yaml.safe_load(Path("config.yaml").read_text()), "records/a")
    key = plan.seals.key("records/a")
    assert key == _plan().seals.key("records/a"), "the job finds what was planned"
    Path("results/.made_from/records/a.json").unlink()
    Path("design.csv").write_text("period_s,acceleration_g\n0,0.3\n0.1,0.5\n0.5,0.5\n4,0.06\n")
    with pytest.raises(
        ConfigurationError, match=r"records/a: a file or a setting changed while the study ran"
    ):
        plan.seals.write("records/a", key, [])
    assert not Path("results/.made_from/records/a.json").exists()


def test_a_job_cannot_read_a_setting_that_its_line_does_not_name(study) -> None:
    settings = TABLE["fragility"].handed(_plan().settings)
    assert settings.fragility.hazard == "hazard.csv" and settings.tolerance == 1e-6
    with pytest.raises(
        ConfigurationError, match=r"setting client: .* add it to rocking\.study\.made_from\.TABLE"
    ):
        _ = settings.client
    level = TABLE["records"].handed(_plan().settings).design_spectrum
    assert level.points == "design.csv" and level.pool is None, "the pool is no part of a record"


def test_a_seal_names_its_files_from_the_results_and_leaves_out_what_is_not_there(tmp_path: Path) -> None:
    file = tmp_path / "a" / "report.pdf"
    file.parent.mkdir()
    file.write_bytes(b"pages")
    seals = Seals(tmp_path, lambda product: {"thing": "1"})
    seals.write("records/a", seals.key("records/a"), [file, tmp_path / "a" / "none.csv"])
    assert '"a/report.pdf"' in seals.path("records/a").read_text()
    assert "none.csv" not in seals.path("records/a").read_text()
    assert seals.why_again("records/a") == ""
