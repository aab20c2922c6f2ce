"""The report of one record: its numbers, its bytes, and what it says when something is wrong."""

import re
import shutil
import subprocess
from dataclasses import fields, replace

import numpy as np
import pytest

from rocking.assessment.method import Method
from rocking.assessment.rows.of_study import structure_rows
from rocking.assessment.verdict import Agreement, Verdict
from rocking.records.accelerogram import Accelerogram
from rocking.reports.record import failure_report, headlines, record_data, record_report
from rocking.structures import Block
from rocking.tables import cell

from .conftest import HOSTILE, SETTINGS, assessed, fate, shaken

NUMBER = re.compile(r"[−-]?\d+(?:\.\d+)?(?:×10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?")
CSV_NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
PLAIN = str.maketrans("−⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "--0123456789")
TABLES = ("verdicts", "facts", "structures", "pulses", "methods", "variations")
PICTURES = ("ground", "strip", "histories", "pulse-figures", "comparison", "measures", "spectra")


def printed_numbers(text: str) -> list[tuple[float, float]]:
    """Numbers in a printed text, each with half a unit of its last digit."""
    found = []
    for token in NUMBER.findall(text):
        mantissa, _, exponent = token.translate(PLAIN).partition("×10")
        scale = 10.0 ** int(exponent or 0)
        decimals = len(mantissa.partition(".")[2])
        found.append((float(mantissa) * scale, 0.5 * 10.0**-decimals * scale))
    return found


def csv_numbers(example) -> np.ndarray:
    """Every number in every cell of the tables, and in percent."""
    tables = [getattr(example.tables, field.name) for field in fields(example.tables)]
    rows = [row for table in [*tables, structure_rows(example.structures)] for row in table]
    cells = (cell(getattr(row, name)) for row in rows for name in row.table.column_names)
    known = np.array([float(token) for text in cells for token in CSV_NUMBER.findall(text)])
    return np.concatenate([known, 100 * known])


def cell_texts(data) -> list[str]:
    """The text of every table cell but the running numbers of the structures."""
    texts = []
    for table in (data[name] for name in TABLES):
        first = 1 if table["heads"][0] == "No." else 0
        for cells in (row[first:] for row in table["rows"]):
            texts += [each.get("text", "") if isinstance(each, dict) else each for each in cells]
    return texts


def report_of(example, **changed) -> dict:
    """The data of the report with other tables."""
    record, accelerograms, structures, tables, settings = example.arguments
    return record_data(record, accelerograms, structures, replace(tables, **changed), settings)


@pytest.fixture(scope="module")
def data(example) -> dict:
    return record_data(*example.arguments)


def test_every_number_in_a_table_stands_in_a_csv(example, data):
    known = csv_numbers(example)
    printed = [number for text in cell_texts(data) for number in printed_numbers(text)]
    assert len(printed) > 100
    for value, half in printed:
        # rounding to the last printed digit, and the rounding of that comparison itself
        assert np.abs(known - value).min() <= half * (1 + 1e-9), value


def test_every_number_in_a_sentence_stands_in_a_csv_or_counts_rows(example, data):
    sentences = [*data["sentences"], *data["pulse-sentences"], *data["doubts"]]
    sentences += [line["names"] for line in data["headlines"]]
    named, known = "|".join(map(re.escape, example.structures)), csv_numbers(example)
    for value, half in printed_numbers(" ".join(re.sub(named, "", text) for text in sentences)):
        assert np.abs(known - value).min() <= half * (1 + 1e-9), value


def test_a_changed_cell_changes_what_is_printed(example):
    maxima = [
        replace(row, rotation_ratio=0.123456789) if row.method is Method.MECHANISM_ON_RECORD else row
        for row in example.tables.maxima
    ]
    table = report_of(example, maxima=maxima)["methods"]
    assert all({"text": "0.123", "strong": True} in row for row in table["rows"])


def test_page_one_begins_with_the_verdicts_by_name_and_holds_no_table(example, data):
    said = {line["verdict"].lower(): line["names"] for line in data["headlines"]}
    assert list(said) == [word for word in ("overturns", "undecided", "stands") if word in said]
    for row in example.tables.verdicts:
        assert row.structure in said[row.verdict]
        if row.verdict is Verdict.UNDECIDED:
            assert f"overturns in {row.overturning_members} of {row.members}" in said[row.verdict]
    assert "PGA 0." in data["key"][0] and " g, PGV " in data["key"][0] and "D5–95" in data["key"][0]


def test_the_reports_own_settings_stand_above_its_title(example):
    *others, settings = example.arguments
    named = record_data(*others, settings | {"client": "A client", "date": "2026-01-02"})
    assert named["about"] == {"study": "", "client": "A client", "author": "", "date": "2026-01-02"}


def test_an_outcome_that_processing_decides_is_said(example):
    ratios = iter([0.3, np.inf])
    maxima = [
        replace(row, rotation_ratio=next(ratios, 0.3))
        if row.processing and row.structure == "arch 20 m"
        else row
        for row in example.tables.maxima
    ]
    said = report_of(example, maxima=maxima)["sentences"]
    assert any("depends on the processing of the record: " in text and "arch 20 m" in text for text in said)


def test_the_reason_of_a_miss_is_told_apart(example):
    """The block under the whole record overturns as the mechanism does: the pulse is the reason."""
    comparison = [
        replace(row, agreement=Agreement.TOO_LOW, integrated_rotation_ratio=np.inf)
        for row in example.tables.comparison
    ]
    rows = {Method.BLOCK_ON_RECORD: np.inf, Method.MECHANISM_ON_PULSE: 0.2}
    responses = [
        replace(row, rotation_ratio=rows.get(row.method, row.rotation_ratio)) for row in example.tables.maxima
    ]
    (said,) = report_of(example, comparison=comparison, maxima=responses)["doubts"]
    assert said.endswith("so the single pulse is the reason.")


def test_the_same_input_gives_the_same_bytes(example):
    assert record_report(*example.arguments) == record_report(*example.arguments)


def test_the_report_is_a_tagged_archive_document_of_at_most_six_pages(example):
    document = record_report(*example.arguments)
    assert document.startswith(b"%PDF-1.7")
    assert b"<pdfaid:part>2</pdfaid:part>" in document and b"<pdfaid:conformance>A" in document
    assert 4 <= max(int(count) for count in re.findall(rb"/Count (\d+)", document)) <= 6


def test_every_picture_has_an_alternative_text_and_no_type_under_seven_points(data):
    pictures = [picture for name in PICTURES for picture in data[name]]
    assert len(pictures) == len(PICTURES)
    for picture in pictures:
        assert len(picture["alt"]) > 20
        sizes = [float(size) for size in re.findall(r"font[^;]*?([\d.]+)px", picture["svg"])]
        assert sizes and min(sizes) >= 7


def extracted(document: bytes) -> str:
    """The text of a PDF, without any white space."""
    if shutil.which("pdftotext") is None:
        pytest.skip(
            "pdftotext (poppler-utils) is not installed; it extracts the text of the PDF for this test"
        )
    run = subprocess.run(["pdftotext", "-raw", "-", "-"], input=document, capture_output=True, check=True)
    return "".join(run.stdout.decode().split())


def test_hostile_names_are_printed_as_they_are_and_the_factor_wherever_numbers_are(hostile):
    document = record_report(*hostile.arguments)
    assert record_report(*hostile.arguments) == document
    text = extracted(document)
    for name in HOSTILE:
        assert "".join(name.split()) in text, name
    assert text.count("×12.5") >= 10
    notice = record_data(*hostile.arguments)["notices"][0]
    assert "×\u00a012.5" in notice["text"] and notice["strong"]


def test_nothing_that_lifts_is_said_first():
    data = record_data(*assessed("still", [shaken()], {"squat": Block.of_size(2.0, 2.0)}).arguments)
    assert any("No structure uplifts" in notice["text"] for notice in data["notices"])
    assert data["histories"] == []


def test_a_record_without_a_structure_or_a_pulse_still_gives_a_document():
    empty = assessed("empty", [shaken()], {})
    assert "No structure could be assessed" in record_data(*empty.arguments)["notices"][0]["text"]
    flat = assessed("flat", [Accelerogram(np.zeros(400), 0.01, "EW")], {"block": Block.of_size(1.0, 4.0)})
    data = record_data(*flat.arguments)
    assert any("No pulse could be sought" in notice["text"] for notice in data["notices"])
    for case in (empty, flat):
        assert record_report(*case.arguments).startswith(b"%PDF")


def test_of_a_hundred_structures_all_are_in_the_tables_and_few_are_drawn(example):
    names = [f"block {place}" for place in range(100)]
    tables = replace(
        example.tables,
        **{
            name: [replace(getattr(example.tables, name)[0], structure=each) for each in names]
            for name in ("comparison", "maxima")
        },
        ensemble=[],
        candidates=[],
    )
    structures = dict.fromkeys(names, example.structures["block 4 m"])
    data = record_data(example.record, example.accelerograms, structures, tables, SETTINGS)
    assert len(data["verdicts"]["rows"]) == len(data["methods"]["rows"]) == 100
    assert "and 88 others" in data["headlines"][0]["names"]
    assert "90 structures" in data["histories-note"]


@pytest.mark.parametrize("message", ["records/x.at2: #panic(1) $x^$ <b>.", "", "W" * 300])
def test_a_failure_is_one_page_that_says_why(message):
    document = failure_report("bad #record$", message)
    assert re.findall(rb"/Count (\d+)", document) == [b"1"]
    assert "".join(message.split()) in extracted(document)


def test_a_contact_that_fails_is_said_first(example):
    responses = [
        replace(row, slides=True, bounces=True) if row.method is Method.MECHANISM_ON_RECORD else row
        for row in example.tables.maxima
    ]
    data = report_of(example, maxima=responses)
    said = f"{next(iter(example.structures))} (slides and bounces)"
    assert any(said in notice["text"] and notice["strong"] for notice in data["notices"])
    assert data["methods"]["rows"][0][-1] == {"text": "slides and bounces", "strong": True}


def test_a_vertical_component_is_named_and_changes_the_histories(example):
    up = Accelerogram(3 * np.sin(np.arange(2000) * 0.1), 0.01, "UP", vertical=True)
    acting = {"vertical_component": "UP", "vertical_peak_acceleration_m_s2": 2.999}
    tables = replace(example.tables, record=[replace(example.tables.record[0], **acting)])
    arguments = (example.record, example.accelerograms, example.structures, tables, SETTINGS)
    still, moved = record_data(*arguments), record_data(*arguments, vertical=up)
    assert "vertical component UP acts" in still["vertical"]
    assert still["histories"][0]["svg"] != moved["histories"][0]["svg"]


def test_the_first_lines_hold_few_long_names_and_say_how_many_more():
    many = [fate(Verdict.STANDS, 0.1, structure=f"{place} {'W' * 60}") for place in range(12)]
    (line,) = headlines(many)
    assert len(line["names"]) < 340 and line["names"].endswith("and eight others")
