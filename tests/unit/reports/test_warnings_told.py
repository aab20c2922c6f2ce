"""Warnings on sizes, levels and settings: rows of one table, which every document of a study reads."""

import re
from dataclasses import replace

import numpy as np
import pytest

from rocking import Block, DesignSpectrum, check
from rocking.assessment.case import RecordResult
from rocking.assessment.conclusion import TO_CHECK
from rocking.assessment.kinds import AssessmentKind
from rocking.assessment.rows import RECORD_TABLES, SUMMARY_TABLES, RecordRows, WarningRow, rows_of_record
from rocking.assessment.scene import Scene, on_the_ground
from rocking.errors import RockingError
from rocking.products.checks.report import CheckedStructure, structures_data
from rocking.quantities import GRAVITY
from rocking.reports.explore import explore_page
from rocking.reports.record import RecordReport
from rocking.reports.summary import summary_data
from rocking.structures.structure_list import TYPES, structure_from_config
from rocking.study.plan import study_warnings
from rocking.study.settings import Settings, StudyDesign
from rocking.study.terminal import closing_lines
from rocking.tables.workbook import workbook

from .conftest import SETTINGS, summarised

TYPED_WRONGLY = 300
UNITS = {"m": 1000.0, "°": np.pi / 180}
"""What a size is multiplied by that is typed in millimetres, or an angle in radians."""


def slips(count: int):
    """Yield `count` entries of a list, or design levels, of usual sizes but one, typed in another unit; by a seed."""
    chance = np.random.default_rng(62)
    forms = [form for of_type in TYPES.values() for form in of_type if form.type_name != "capacity_curve"]
    while count:
        if chance.random() < 0.1:
            level = float(chance.uniform(0.07, 0.35))
            yield "design_spectrum.ag_g", {"ag": level * GRAVITY, "f0": 2.4, "tc_star": 0.35}
            count -= 1
            continue
        form = forms[chance.integers(len(forms))]
        values = {attribute.key: attribute.value.example for attribute in form.fields if attribute.required}
        sizes = [
            one_attribute
            for one_attribute in form.fields
            if one_attribute.value.unit in UNITS
            and one_attribute.value.usual
            and one_attribute.value.usual[0] > 0  # about zero no unit is unlikely
            and np.isscalar(one_attribute.value.example)
        ]
        size = sizes[chance.integers(len(sizes))]
        low, high = size.value.usual
        usual = np.exp(chance.uniform(np.log(max(low, high / 100)), np.log(high)))
        yield size.key, {"type": form.type_name, **values, size.key: float(usual * UNITS[size.value.unit])}
        count -= 1


def study_of(key: str, entry: dict) -> tuple:
    """The warnings on the study in which that was typed; None where it is refused."""
    try:
        if key.startswith("design_spectrum"):
            return study_warnings(Settings(design_spectrum=StudyDesign(**entry)), {})
        scene = Scene("front wall", structure_from_config(entry))
    except RockingError:
        return None
    return study_warnings(Settings(), {scene.name: scene})


def wall_in_millimetres(height: float):
    """A wall of that height, and 300 thick, as somebody types it who thinks in millimetres."""
    return structure_from_config({"type": "wall", "height_m": height, "thickness_m": 300.0})


def notices(warnings) -> list[str]:
    """What stands above page one of a record."""
    of_study = WarningRow.of_study(warnings)
    report = RecordReport(RecordResult(record="r"), RecordRows(), {}, SETTINGS, of_study=of_study)
    return [notice.text for notice in report.page().notices]


def assumed(report: RecordReport) -> str:
    """What a report says of the ground motion under what was assumed."""
    (topic,) = (topic for topic in report.page().assumed.topics if topic.topic == "Ground motion")
    return " ".join(topic.texts)


def lines_told(rows):
    """What the end of a run tells of the warnings, one string a warning."""
    text = "\n".join(closing_lines([], [], [], warnings=rows))
    return re.sub(r"\n {8}", " ", text).splitlines()


@pytest.mark.filterwarnings("ignore:restitution by momentum balance")
def test_a_size_or_a_level_in_another_unit_stands_on_page_one_or_is_refused(monkeypatch):
    """300 studies with one slip each: millimetres for metres, radians for degrees, m/s² for g."""
    # Half a second each, for a sentence that refuses.
    monkeypatch.setattr("rocking.structures.arch.limiting_thickness", lambda *_: 1.0)
    silent = []
    refused = 0
    for key, entry in slips(TYPED_WRONGLY):
        warnings = study_of(key, entry)
        if warnings is None:
            refused += 1
            continue
        told = [
            one_warning
            for one_warning in warnings
            if one_warning.kind in TO_CHECK and one_warning.about.endswith(key)
        ]
        if not told:
            silent.append((key, entry))
        page = notices(warnings)
        assert all(any(str(warning) in notice for notice in page) for warning in told[:2]), (key, entry)
    assert not silent, silent
    assert refused < TYPED_WRONGLY / 2


@pytest.mark.filterwarnings("ignore:restitution by momentum balance")
def test_of_many_slips_page_one_tells_the_first_in_full_and_how_many_more_of_what():
    wall = wall_in_millimetres(2200.0)
    warnings = study_warnings(Settings(), on_the_ground({f"wall {place}": wall for place in range(150)}))
    to_check = [warning for warning in warnings if warning.kind in TO_CHECK]
    assert len(to_check) == 300
    *first, rest = notices(warnings)[-3:]
    assert first == [str(item) for item in to_check[:2]]
    assert lines_told(WarningRow.of_study(warnings)) == [*first, rest], "as the terminal tells them"
    assert "298 values" in rest and "wall 1, wall 2, " in rest and "warnings.csv" in rest


@pytest.mark.usefixtures("undrawn")
@pytest.mark.filterwarnings("ignore:restitution by momentum balance")
def test_every_document_of_a_study_reads_the_same_warnings(example):
    """Page one, summary, page to sign, page to explore and workbook; both tables are outputs of their rules."""
    settings = Settings(design_spectrum=StudyDesign(ag=1.96, f0=2.4, tc_star=0.35))
    wall = wall_in_millimetres(2200.0)
    scene = Scene("A", wall)
    warnings = study_warnings(settings, {"A": scene})
    rows = WarningRow.of_study(warnings)
    told = [row.sentence for row in rows if row.kind in TO_CHECK]
    assert [row.about for row in rows] == ["design_spectrum.ag_g", "A: height_m", "A: thickness_m", "A"]
    assert [row.kind for row in rows][-1] is AssessmentKind.HELD_AT_CEILING
    assert WarningRow in RECORD_TABLES and WarningRow in SUMMARY_TABLES

    report = replace(example, of_study=rows)
    page = report.page()
    assert told == [notice.text for notice in page.notices if notice.text in told]
    (models,) = (topic.texts for topic in page.known.topics if topic.topic == "Models")
    assert rows[-1].sentence in models

    tables = summarised(example.tables, example.structures) | {WarningRow: rows}
    assert told == [
        one_notice.text for one_notice in summary_data(tables, SETTINGS).notices if one_notice.text in told
    ]

    spectrum = DesignSpectrum.ntc(1.96 * GRAVITY, 2.4, 0.35)
    block = Block.of_size(0.6, 2.0)
    signed = CheckedStructure(name="A", structure=block, checked=check(block, spectrum), warnings=warnings)
    (sheet,) = structures_data([signed], spectrum, settings.for_pages).sheets
    assert told == [detail for detail in sheet.details if detail in told]
    assert rows[-1].sentence in sheet.answers[0].assumptions

    assert told == [line for line in lines_told([*rows, *rows]) if line in told]

    html = explore_page([], {"A": block}, warnings=rows).decode()
    assert all(row.sentence in html for row in rows)
    assert WarningRow.table.file_name == "warnings.csv"
    assert len(workbook(tables)) > 0


def test_a_vertical_component_that_is_asked_for_and_missing_is_told(example):
    asked, unasked = (rows_of_record(example.result, vertical=choice).warnings for choice in (True, False))
    assert [row.kind for row in asked if row not in unasked] == [AssessmentKind.VERTICAL_MISSING]
    (row,) = (question for question in asked if question.kind is AssessmentKind.VERTICAL_MISSING)
    assert (row.record, row.about) == (example.result.record, "vertical")
    report = replace(example, tables=replace(example.tables, warnings=asked))
    assert row.sentence in [notice.text for notice in report.page().notices]
    assert "vertical" not in assumed(report), "the warning says it, and no second sentence does"
    assert row.sentence in lines_told(asked) and row.sentence not in lines_told(unasked)
    report = replace(example, tables=replace(example.tables, warnings=unasked))
    assert "vertical component is left out" in assumed(report)
    acting = [replace(item, vertical_component="UP") for item in example.tables.record]
    report = replace(example, tables=replace(example.tables, warnings=unasked, record=acting))
    assert "UP" in assumed(report)
