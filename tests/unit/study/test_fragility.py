"""The fragility of a study: its tables say what the curves are, and a bad record costs no other."""

import math
from dataclasses import replace
from importlib import import_module
from itertools import pairwise
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from scipy.signal import lsim

from rocking.assessment.rows import FailureRow
from rocking.assessment.scene import Scene, on_the_ground
from rocking.catalogue.catalogue import CatalogueRecord
from rocking.errors import ConfigurationError
from rocking.floors.place import Place
from rocking.floors.support import Mode, Support
from rocking.fragility.measures import compared
from rocking.motion import integrate
from rocking.products.fragility.report import write_fragility_report
from rocking.products.fragility.rows import FRAGILITY_TABLES, FragilityRow, FragilitySummaryRow, IdaRow
from rocking.products.fragility.work import Fragilities, write_fragility
from rocking.quantities import GRAVITY
from rocking.records import Accelerogram
from rocking.structures import Block, Spire
from rocking.study.documents import made_or_failed
from rocking.study.job import Study
from rocking.study.settings import Settings, StudyFragility
from rocking.tables import read_rows, read_table
from tests.made_structures import HELD
from tests.refusals import refused
from tests.synthetic import SyntheticRecord, at2_text
from tests.unit.study.made_jobs import made_job

ALONE = HELD.mechanism()
"""It has no joints but its own, and an unbreakable tie holds it for good."""
STRUCTURES = {"slender": Block.of_size(0.5, 3.0), "stout": Block.of_size(1.0, 3.0), "spire": Spire(1.0, 6.0)}


def _study(**fragility: object) -> Study:
    settings = StudyFragility(**({"members": False} | fragility))
    return Study(on_the_ground(STRUCTURES), Settings(fragility=settings), "made")


def _records(folder: Path, count: int) -> list[CatalogueRecord]:
    records = []
    for seed in range(count):
        recipe = SyntheticRecord(name=f"made{seed}", seed=seed, pulse_period=0.4 + 0.2 * seed)
        (folder / f"made{seed}.AT2").write_text(at2_text(recipe))
        cells = {"unit": "g", "event": "made", "station": str(seed), "folder": folder}
        records.append(CatalogueRecord(f"made{seed}", f"made{seed}.AT2", **cells))
    return records


def _but_earthquakes(reasons: list[str]) -> list[str]:
    """What is said of anything but the earthquakes: the made records are of one."""
    return [reason for reason in reasons if "earthquake" not in reason]


def test_what_cannot_overturn_is_left_out_and_said(tmp_path):
    records = _records(tmp_path, 2)
    both = replace(_study(), scenes=on_the_ground({"held": ALONE, "slender": STRUCTURES["slender"]}))
    _, told = write_fragility(records, both, tmp_path / "out")
    (unused,) = _but_earthquakes(told)
    assert unused.startswith("held: it cannot overturn, and has no fragility: it lifts at 0.263 g")
    rows = read_rows(FragilitySummaryRow, tmp_path / "out" / FragilitySummaryRow.table.file_name)
    assert {row.structure for row in rows} == {"slender"}
    with refused(ConfigurationError, "structures", ["held"]):
        write_fragility(records, replace(both, scenes=on_the_ground({"held": ALONE})), tmp_path / "none")
    assert not (tmp_path / "none").exists()


def test_a_table_beside_the_curves_fails_alone(tmp_path, monkeypatch, capsys):
    """A singular matrix in what explains the curves took the finished fragility along."""

    def singular(*_: object) -> None:
        raise np.linalg.LinAlgError("Singular matrix")

    monkeypatch.setattr(import_module("rocking.products.fragility.rows"), "explanation", singular)
    study = replace(_study(), scenes=on_the_ground({"slender": STRUCTURES["slender"]}))
    log = tmp_path / "fragility.log"
    written, reasons = write_fragility(_records(tmp_path, 2), study, tmp_path / "out", lambda *_: None, log)
    (fault,) = written[FailureRow]
    assert (fault.structure, fault.stage, _but_earthquakes(reasons)) == ("slender", "fault", [])
    said = "a fault of rocking in its rows of intensity_measures.csv (LinAlgError: Singular matrix)"
    assert fault.message.startswith(said) and fault.message.endswith(f", with {log}.")
    assert "LinAlgError: Singular matrix\n" in capsys.readouterr().err
    rows = {name: read_table(row_class, tmp_path / "out") for name, row_class in FRAGILITY_TABLES.items()}
    assert {name for name, held in rows.items() if not held} == {"intensity_measures"}


def test_a_fault_of_a_record_or_a_structure_costs_no_other_and_is_a_row(tmp_path, monkeypatch, capsys):
    """Planted in the reading of one record of three, and in the curve of one structure of two."""
    records = _records(tmp_path, 3)
    study = replace(_study(), scenes=on_the_ground({name: STRUCTURES[name] for name in ("slender", "stout")}))
    expected = replace(study, scenes=on_the_ground({"slender": STRUCTURES["slender"]}))
    write_fragility(records[:2], expected, tmp_path / "expected")
    curves = import_module("rocking.fragility.curves")
    follow, read = curves.fragility, Study.open

    def faulty(accelerograms, structure, **settings):
        return (
            {}["planted"]
            if structure == STRUCTURES["stout"]
            else follow(accelerograms, structure, **settings)
        )

    def opened(study, record, *rest):
        return 1 // 0 if record.id == "made2" else read(study, record, *rest)

    monkeypatch.setattr("rocking.products.fragility.work.fragility", faulty)
    monkeypatch.setattr(Study, "open", opened)
    log = tmp_path / "fragility.log"
    written, reasons = write_fragility(records, study, tmp_path / "out", lambda *_: None, log)
    assert [(failure.record, failure.structure) for failure in written[FailureRow]] == [
        ("made2", ""),
        ("", "stout"),
    ]
    trace = capsys.readouterr().err
    for failure, said in zip(written[FailureRow], ("ZeroDivisionError", "KeyError: 'planted'"), strict=True):
        assert said in failure.message and failure.message.endswith(f", with {log}.")
        assert said in trace
    assert _but_earthquakes(reasons) == []
    for row_class in FRAGILITY_TABLES.values():
        names = [folder / row_class.table.file_name for folder in (tmp_path / "out", tmp_path / "expected")]
        assert names[0].read_bytes() == names[1].read_bytes()
    told: list[dict] = []
    monkeypatch.setattr(
        "rocking.reports.printing.compile_document", lambda page: told.append(page) or b"%PDF"
    )
    write_fragility_report(written, tmp_path / "curves.pdf", tmp_path / "curves.svg")
    listed = [list(part.sentences) for part in told[0].parts if part.sentences]
    assert listed == [
        [f"made2: {written[FailureRow][0].message}", f"stout: {written[FailureRow][1].message}"]
    ]


def test_where_every_structure_has_a_fault_the_page_says_so(tmp_path, monkeypatch):
    """And its tables have heads alone, so that what waits for them goes on."""
    monkeypatch.setattr("rocking.products.fragility.work.fragility", lambda *_, **__: 1 // 0)
    job = made_job(_records(tmp_path, 2), _study(), tmp_path / "results", "fragility")
    told: list[dict] = []
    monkeypatch.setattr(
        "rocking.reports.printing.compile_document", lambda page: told.append(page) or b"%PDF"
    )
    pdf, image = job.folder / "fragility.pdf", job.folder / "fragility.svg"
    made = Fragilities().make(job)
    assert [failure.structure for failure in made.rows[FailureRow]] == list(STRUCTURES)
    assert len(told[0].parts[0].sentences) == 3 and pdf.is_file() and image.is_file()
    image.unlink()
    made_or_failed(pdf, lambda: {}["page"], job.log, image=image)
    assert "a fault of rocking in fragility.pdf (KeyError: 'page')" in told[1].parts[0].sentences[0]
    assert image.is_file()


@pytest.mark.process
def test_the_tables_tell_the_curves_and_a_bad_record_costs_no_other(tmp_path):
    records = _records(tmp_path, 3)
    (tmp_path / "made2.AT2").write_bytes(b"not a record")
    told: list[str] = []
    written, reasons = write_fragility(
        records, _study(), tmp_path / "out", lambda line, *_: told.append(line)
    )
    (unused,) = _but_earthquakes(reasons)
    assert "made2" in unused and told == ["1 of 3: slender", "2 of 3: stout", "3 of 3: spire"]
    rows = {
        name: list(read_rows(row_class, tmp_path / "out" / row_class.table.file_name))
        for name, row_class in FRAGILITY_TABLES.items()
    }
    curves = [row for row in rows["fragility"] if row.structure == "slender" and math.isinf(row.threshold)]
    for curve in curves:
        outcomes = [row for row in rows["ida"] if row.structure == "slender" and row.level == curve.level]
        assert len(outcomes) == 2
        assert curve.probability == sum(row.overturning_share for row in outcomes) / 2
    assert {row.records for row in rows["fragility_summary"]} == {2}
    assert {row.threshold for row in rows["fragility"]} == {0.1, 0.3, 0.5, math.inf}
    medians = {row.structure: row.median for row in rows["fragility_summary"] if math.isinf(row.threshold)}
    assert medians["slender"] < medians["stout"]
    for structure, body in STRUCTURES.items():
        names = {row.intensity_measure for row in rows["intensity_measures"] if row.structure == structure}
        assert names == {measure.name for measure in compared(body.mechanism())}
    assert written.pop(FailureRow) == []
    assert {row_class.table.name: of_it for row_class, of_it in written.items()} == rows
    write_fragility_report(written, tmp_path / "curves.pdf", tmp_path / "curves.svg")
    assert (tmp_path / "curves.pdf").read_bytes().startswith(b"%PDF")


@pytest.mark.parametrize(
    ("count", "hazard", "field", "value"),
    [
        (1, "", "", None),  # of one station no structure has a fragility; each says why in a row
        (3, "0.1,0.001\n0.2,0.002\n", "annual_rate", 0.002),
        (3, "0.2,0.01\n0.1,0.001\n", "intensity", 0.1),
        (3, "0.1,0.01\n", "points", 1),
        (3, "0.1,0.01\n0.2,0\n", "annual_rate", (0.2, 0.0)),
    ],
)
def test_bad_input_is_refused_before_anything_is_written(tmp_path, count, hazard, field, value):
    (tmp_path / "hazard.csv").write_text(f"intensity,annual_rate\n{hazard}")
    settings = {"hazard": str(tmp_path / "hazard.csv")} if hazard else {}
    with refused(ConfigurationError, field, value):
        write_fragility(_records(tmp_path, count), _study(**settings), tmp_path / "out")
    assert not (tmp_path / "out").exists()


def test_openquake_gets_a_function_of_each_structure(tmp_path):
    """Its levels and probabilities are those of the table, of the crack that governs where several may form.

    A measure that OpenQuake lacks leaves a model without functions behind, which says why.
    """
    out = tmp_path / "out"
    _, reasons = write_fragility(_records(tmp_path, 2), _study(), out)
    root = ElementTree.parse(out / "fragility.xml").getroot()
    functions = {function.get("id"): function for function in root.findall(".//{*}fragilityFunction")}
    rows = [row for row in read_table(FragilityRow, out) if math.isinf(row.threshold)]
    rows = [row for row in rows if not math.isnan(row.probability)]
    assert list(functions) == list(dict.fromkeys(row.structure for row in rows))
    for name, function in functions.items():
        own = [row for row in rows if row.structure == name]
        levels, shares = (function.findtext(f"{{*}}{tag}").split() for tag in ("imls", "poes"))
        assert np.array(levels, float) == pytest.approx([100 * row.level for row in own])  # cm/s
        assert np.array(shares, float) == pytest.approx([row.probability for row in own])
    assert not any("OpenQuake" in reason for reason in reasons)
    _, reasons = write_fragility(_records(tmp_path, 2), _study(intensity_measure="p_pgv"), out)
    assert any("OpenQuake lacks" in reason for reason in reasons)
    root = ElementTree.parse(out / "fragility.xml").getroot()
    assert not root.findall(".//{*}fragilityFunction")
    assert "OpenQuake lacks" in root.findtext(".//{*}description")


def test_a_hazard_curve_gives_annual_rates(tmp_path):
    hazard = tmp_path / "hazard.csv"
    hazard.write_bytes(b"intensity,annual_rate\r\n0.01,0.1\r\n10,0.00001\r\n")  # as Windows ends lines
    write_fragility(_records(tmp_path, 2), _study(hazard=str(hazard)), tmp_path / "out")
    rows = list(read_rows(FragilitySummaryRow, tmp_path / "out" / "fragility_summary.csv"))
    assert all(0 <= row.annual_rate_low <= row.annual_rate <= row.annual_rate_high <= 0.1 for row in rows)
    by_threshold = [row.annual_rate for row in rows if row.structure == "slender"]
    assert by_threshold == sorted(by_threshold, reverse=True), "the larger the rotation the rarer"


def test_each_structure_has_the_measure_that_follows_from_it(tmp_path):
    """A record that cannot tell the periods of a large structure is left out of it alone, and no hazard is misread."""
    hazard = tmp_path / "hazard.csv"
    facts = "#,,,\"kind='mean', investigation_time=50.0, imt='AvgSA'\"\n"
    hazard.write_text(facts + "lon,lat,depth,poe-0.01,poe-10\n1,2,0,0.9,0.0001\n")
    structures = {
        "slender": STRUCTURES["slender"],
        "one-sided": Block.of_size(0.6, 3.0, one_sided=True, restitution=0.6),
        "huge": Block.of_size(10.0, 200.0),
    }
    study = _study(hazard=str(hazard), intensity_measure="AvgSA")
    records = _records(tmp_path, 3)
    for place, record in enumerate(records):
        records[place] = replace(record, high_pass=0.1)
    _, reasons = write_fragility(records, replace(study, scenes=on_the_ground(structures)), tmp_path / "out")
    rows = list(read_rows(FragilitySummaryRow, tmp_path / "out" / "fragility_summary.csv"))
    assert {row.structure for row in rows} == {"slender", "one-sided"}
    for row in rows:
        assert row.intensity_measure.startswith("AvgSA(" if row.structure == "slender" else "pgv")
        assert math.isnan(row.annual_rate) == (row.structure == "one-sided")
    reasons = _but_earthquakes(reasons)
    assert [reason.partition(":")[0] for reason in reasons] == [
        "one-sided",
        "made0",
        "made1",
        "made2",
        "huge",
    ]
    assert "it needs a period of" in reasons[1] and "come from 0 station" in reasons[4]


DAMPING, PARTICIPATION = 0.05, 1.3
PERIODS = (0.25, 0.6)
FINER = 5
BODY = Block.of_size(0.5, 2.0)


def _floor(ground: Accelerogram, period: float) -> Accelerogram:
    """The floor of one mode by scipy's state space, a_g + Γψ u'' with u'' = −a_g − 2ξωu' − ω²u, and as it rings on.

    The ground is a straight line between its samples; the floor is not, and is sampled more finely.
    """
    if period == 0:
        return ground
    omega = 2 * math.pi / period
    stiffness, damping = omega**2, 2 * DAMPING * omega
    times = np.arange(0, ground.duration + 20 * period, ground.time_step / FINER)
    samples = np.append(ground.acceleration, 0.0)
    acceleration = np.interp(times, ground.time_step * np.arange(samples.size), samples)
    system = ([[0, 1], [-stiffness, -damping]], [[0], [-1]], [[-stiffness, -damping]], [[-1]])
    _, relative, _ = lsim(system, acceleration, times)
    floor = acceleration + PARTICIPATION * relative
    return replace(ground, acceleration=floor, time_step=ground.time_step / FINER)


def _by_hand(curve: list[tuple[float, float]], scale: float, slope: float) -> float:
    """Return ∫ P |dν| = ∫ ν dP under ν = k x⁻ˢ, for P that rises from 0 at the first level in straight lines of ln x.

    Between levels a and b the mean of ν over ln x is k (a⁻ˢ − b⁻ˢ) / (s ln(b/a)).
    """
    first, start = curve[0]
    rate = start * scale * first**-slope
    for (a, before), (b, after) in pairwise(curve):
        mean = scale * (a**-slope - b**-slope) / (slope * math.log(b / a))
        rate += (after - before) * mean
    return rate


def test_the_rate_of_each_period_of_a_support_is_the_one_by_hand(tmp_path):
    """Who falls where is followed on floors of scipy's, and what a year brings of it is a sum of closed integrals."""
    scale, slope, lowest, highest = 2e-5, 2.5, 0.02, 10.0
    hazard = tmp_path / "hazard.csv"
    points = [f"{level},{scale * level**-slope}" for level in (lowest, highest)]
    hazard.write_text("\n".join(["intensity,annual_rate", *points]))
    supports = tuple(
        Support((Mode(period=period, damping_ratio=DAMPING, participation=PARTICIPATION),))
        for period in PERIODS
    )
    carried = {"parapet": Scene("parapet", BODY, Place("roof", supports))}
    study = replace(_study(hazard=str(hazard), intensity_measure="pga"), scenes=carried)
    records = _records(tmp_path, 3)
    _, unused = write_fragility(records, study, tmp_path / "out")
    assert _but_earthquakes(unused) == []

    outcomes = list(read_rows(IdaRow, tmp_path / "out" / "ida.csv"))
    summaries = read_rows(FragilitySummaryRow, tmp_path / "out" / "fragility_summary.csv")
    told = {row.support_period_s: row.annual_rate for row in summaries if math.isinf(row.threshold)}
    by_hand = {}
    widths: list[float] = []
    for period in (0.0, *PERIODS):
        rates = []
        for record in records:
            (ground,), _ = study.open(record)
            floor = _floor(ground, period)
            own = [
                row
                for row in outcomes
                if row.support_period_s == period and row.station == f"made; {record.station}"
            ]
            factors = [row.level * GRAVITY / ground.peak_acceleration for row in own]
            falls = [math.isinf(integrate(BODY, floor.scaled(factor)).rotation_ratio) for factor in factors]
            assert [row.overturning_share for row in own] == falls
            curve = [(row.level, row.overturning_share) for row in own]
            widths += [math.log(after.level / before.level) for before, after in pairwise(own)]
            rates.append(_by_hand(curve, scale, slope))
        by_hand[period] = sum(rates) / len(rates)
    # Of 400 equal steps in ln x, each counts the curve at its middle: a kink within one, where the curve begins or ends
    # to rise by 1 over the width of two levels, is missed by at most step² / (8 width) of what ν changes by.
    step = math.log(highest / lowest) / 400
    assert told == pytest.approx(by_hand, rel=2 * slope * step**2 / (8 * min(widths)))
    ground, stiff, soft = told.values()
    assert ground < 0.9 * stiff < 0.5 * soft, "so that no rate could stand in the row of another period"
