"""Whoever prints a case, to whatever reader, prints the same word, share and doubt: those of the one decision."""

import math
import zipfile
from dataclasses import replace
from functools import partial
from io import BytesIO
from pathlib import Path
from xml.etree import ElementTree

import pytest

from rocking.assessment.case import PeriodResult
from rocking.assessment.cracks import CrackEnsembles, FollowedCrack
from rocking.assessment.decide import Limit, Verdict
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.rows import VerdictRow, rows_of_record
from rocking.codes.design_spectrum import DesignSpectrum
from rocking.codes.dynamic_check import check
from rocking.products.checks.report import structures_data
from rocking.products.checks.work import _checked
from rocking.reports.explore import explore_page, record_content
from rocking.reports.printing import LOOKS, cell_text
from rocking.reports.record import RecordReport
from rocking.reports.summary import summary_data
from rocking.study.own_files import _lines_of
from rocking.study.terminal import record_line
from rocking.tables import frame, write_rows
from rocking.tables.workbook import workbook
from rocking.warnings import RockingWarning
from tests.unit.assessment.made_rows import members
from tests.unit.reports.conftest import SETTINGS, summarised

ROOT = Path(__file__).parents[3]
NO_BREAK = "\u00a0"
SPECTRUM = DesignSpectrum.ntc(ag=2.0, f0=2.5, tc_star=0.35)


def with_members(station, falls, limits=()):
    """The result with ensembles of 64 of each of its cracks, of which so many overturn, and what limits its word."""
    cracks = tuple(
        FollowedCrack(f"hinge {place}" if len(falls) > 1 else "", math.nan, members(fall))
        for place, fall in enumerate(falls)
    )
    ensembles = CrackEnsembles(cracks)
    cases = {
        name: replace(case, ensembles=ensembles, limits=limits, reserve=None)
        for name, case in station.cases.items()
    }
    return PeriodResult.of(station.scene, cases, station.directions, station.support)


@pytest.fixture(scope="module")
def report(example) -> RecordReport:
    """The example with as many words as it has structures; one is doubtful, and of one the cracks disagree."""
    made = {
        "block 4 m": ([64], ()),
        "block 1 m": ([50], ()),
        "wall 3 m": ([0, 63], ()),
        "arch 20 m": ([12], (Limit.untold(RockingWarning(AssessmentKind.CONTACTS_OPEN)),)),
    }
    scenes = {
        name: replace(
            scene,
            periods=tuple(
                with_members(period, *made[name]) if name in made else period for period in scene.periods
            ),
        )
        for name, scene in example.result.scenes.items()
    }
    result = replace(example.result, scenes=scenes)
    return replace(example, result=result, tables=rows_of_record(result, "cd" * 32, "CC0-1.0"))


@pytest.fixture(scope="module")
def decisions(report):
    """The decision on each structure: what everybody has to say."""
    return {period.structure: period.decision for period in report.result.periods}


def test_the_example_has_five_words_a_range_and_a_doubt(decisions):
    words = {name: str(decision.verdict) for name, decision in decisions.items()}
    assert words == {
        "block 4 m": "overturns",
        "block 1 m": "probably overturns",
        "wall 3 m": "uncertain",
        "arch 20 m": "cannot be told",
        "squat block": "stands",
    }
    assert decisions["wall 3 m"].share_in_words == f"0–98{NO_BREAK}%"
    assert decisions["arch 20 m"].share_in_words == f"at least 19{NO_BREAK}%"


def test_the_tables_hold_it(report, decisions, tmp_path):
    write_rows(VerdictRow, report.tables.verdicts, tmp_path / "verdicts.csv")
    for row in frame(VerdictRow, tmp_path / "verdicts.csv").itertuples():
        assert printed(row) == in_print(decisions[row.structure])
    assert report.tables.comparison
    for row in report.tables.comparison:
        decision = decisions[row.structure]
        assert row.verdict is decision.verdict
        assert row.overturning_share == pytest.approx(decision.share, nan_ok=True)


def test_the_workbook_holds_it(report, decisions):
    lines = workbook_lines(report.tables)
    for name, decision in decisions.items():
        (line,) = (one_line for one_line in lines if f"|{name}|" in f"|{one_line}|")
        assert f"|{decision.verdict}|" in line
        assert decision.why in line
        assert all(warning.kind in line for warning in decision.warnings)


def test_the_terminal_says_it(report, decisions):
    line = record_line(report.tables.verdicts, [])
    told = [text for period in report.result.periods for text in _lines_of(period, 1.0)]
    for name, decision in decisions.items():
        (own,) = (text for text in told if text.startswith(f"{name}: "))
        assert own == f"{name}: {decision.verdict} ({decision.share_in_words}); {decision.why}"
        said = name if decision.verdict is Verdict.STANDS else f"{name} ({decision.share_in_words})"
        assert f"{decision.verdict}: {said}" in line


@pytest.mark.usefixtures("undrawn")
def test_page_one_says_it(report, decisions):
    data = report.page()
    rows = {row.name: row for row in data.page_one.rows}
    for name, decision in decisions.items():
        assert rows[name].chip.verdict.removeprefix("? ") == decision.verdict
        assert rows[name].chip.share == decision.share_in_words
        assert rows[name].chip.fill == LOOKS[decision.verdict][1]
    assert rows["arch 20 m"].chip.hatched, "whose contacts open, so that it cannot be told"


@pytest.mark.usefixtures("undrawn")
def test_the_summary_says_it(report, decisions):
    data = summary_data(summarised(report.tables, report.structures), SETTINGS)
    assert data.conclusion == "2 of 5 structures overturn or probably do; 1 is uncertain, 1 cannot be told."
    cells = {row.name: row.cells[0] for row in data.matrix.rows}
    table = {line[0].text: line for line in data.structures.table.rows}
    for name, decision in decisions.items():
        assert cells[name].verdict.removeprefix("? ") == decision.verdict
        assert cells[name].share in ("", decision.share_in_words)
        assert cells[name].fill == LOOKS[decision.verdict][1]
        assert decision.share_in_words in table[name]


def test_the_page_to_explore_says_it(report, decisions):
    content = record_content(report.result, report.tables, report.structures)
    sentence = "2 of 5 structures overturn or probably do; 1 is uncertain, 1 cannot be told."
    assert sentence in explore_page([content], report.structures).decode()
    assert report.page().conclusion == sentence, "as on page one"
    cases = content["cases"]
    for name, decision in decisions.items():
        assert cases[name]["verdict"] == decision.verdict
        assert cases[name]["cell"] == cell_text(decision)
        assert cases[name]["text"].startswith(
            f"{decision.verdict}, {decision.share_in_words}: {decision.why}."
        )
        warnings = "; ".join(map(str, decision.warnings))
        assert not warnings or f" Warning: {warnings}." in cases[name]["text"]


@pytest.mark.usefixtures("undrawn")
def test_the_page_to_sign_says_it(report, decisions):
    """Of one record: its word, the mean of one share, and the doubt."""
    stations = {row.record: (row.station, row.event) for row in report.tables.record}
    for name, decision in decisions.items():
        own = [row for row in report.tables.verdicts if row.structure == name]
        page = _checked(
            report.result.scenes[name].scene, None, partial(check, spectrum=SPECTRUM), own, stations
        )
        (data,) = structures_data([page], SPECTRUM, SETTINGS).sheets
        share = data.answers[0].basis.share
        assert f"{decision.verdict.predicate} under 1 station" in share
        if not math.isnan(decision.share):
            assert f"{100 * decision.share:.0f}{NO_BREAK}%" in [
                sentence.value for sentence in data.answers[0].sure
            ]
        warnings = "; ".join(map(str, decision.warnings))
        assert not warnings or f"({warnings})" in share


def in_print(decision):
    """What a table holds of a decision: of its doubts, and of what would tell more, the kinds alone."""
    kinds = (
        "; ".join(warning.kind for warning in warnings)
        for warnings in (decision.warnings, decision.would_settle)
    )
    shares = (decision.share, *decision.interval)
    return repr((str(decision.verdict), *map(float, shares), decision.why, *kinds))


def printed(row):
    """The same of a row of verdicts.csv."""
    shares = (row.overturning_share, row.share_low, row.share_high)
    return repr((str(row.verdict), *shares, row.why, row.warnings, row.would_settle))


def workbook_lines(tables):
    """The lines of the sheet of verdicts."""
    with zipfile.ZipFile(BytesIO(workbook({VerdictRow: tables.verdicts}, "A study"))) as book:
        sheet = ElementTree.fromstring(book.read("xl/worksheets/sheet2.xml"))
    tag = "{http://schemas.openxmlformats.org/spreadsheetml/2006/main}row"
    return ["|".join("".join(cell.itertext()) for cell in line) for line in sheet.iter(tag)]
