"""The report of one record: its numbers, its bytes, and what it says when something is wrong."""

import re
import shutil
import subprocess
from dataclasses import fields, replace

import numpy as np
import pytest

from rocking.assessment.method import Method
from rocking.assessment.rows.of_study import structure_rows
from rocking.assessment.verdict import Verdict
from rocking.records.accelerogram import Accelerogram
from rocking.reports.record.page_one import fate_lines, headlines
from rocking.reports.record.report import failure_report, record_data, record_report
from rocking.structures import Block
from rocking.structures.outcome import Outcome
from rocking.tables import cell

from .conftest import HOSTILE, SETTINGS, assessed, shaken
from .drawn import texts

NUMBER = re.compile(r"[−-]?\d+(?:\.\d+)?(?:×10[⁻⁰¹²³⁴⁵⁶⁷⁸⁹]+)?")
CSV_NUMBER = re.compile(r"-?\d+(?:\.\d+)?(?:e[+-]?\d+)?")
PLAIN = str.maketrans("−⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "--0123456789")
TABLES_OF_NUMBERS = ("fates", "identity", "structures", "methods", "trust", "candidates", "processing")


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
    """Every number in every cell of the tables."""
    tables = [getattr(example.tables, field.name) for field in fields(example.tables)]
    rows = [row for table in [*tables, structure_rows(example.structures)] for row in table]
    cells = (cell(getattr(row, name)) for row in rows for name in row.table.column_names)
    return np.array([float(token) for text in cells for token in CSV_NUMBER.findall(text)])


def shown_tables(data) -> list[dict]:
    """Every table of numbers in the data of the template."""
    parts = [part["table"] for name in ("verdicts", "pulses") for part in data[name]]
    return parts + [data[name] for name in TABLES_OF_NUMBERS]


def cell_texts(data) -> list[str]:
    """The text of every table cell but the running numbers of the structures."""
    texts = []
    for table in shown_tables(data):
        first = 1 if table["heads"][0] == "No." else 0
        cells = (cell for row in table["rows"] for cell in row[first:])
        texts += [cell.get("text", "") if isinstance(cell, dict) else cell for cell in cells]
    return texts


def test_every_number_in_a_table_stands_in_a_csv(example):
    known = csv_numbers(example)
    texts = [text for text in cell_texts(record_data(*example.arguments)) if text != "Eq. 15 exact"]
    printed = [number for text in texts for number in printed_numbers(text)]
    assert len(printed) > 100
    for value, half in printed:
        # rounding to the last printed digit, and the rounding of that comparison itself
        assert np.abs(known - value).min() <= half * (1 + 1e-9), value


def test_the_two_defects_of_each_block_are_said_in_percent(example):
    table = record_data(*example.arguments)["structures"]
    place = table["heads"].index("Type and geometry")
    for line, structure in zip(table["rows"], example.structures.values(), strict=True):
        defects = structure.mechanism().block_defects
        said = line[place]["below"]
        (restoring, half), (forcing, other_half) = printed_numbers(said)
        assert re.fullmatch(r"a block to \S+ in restoring and \S+ in forcing", said.replace("\u00a0", ""))
        assert restoring == pytest.approx(100 * defects.restoring, abs=half + 1e-9)
        assert forcing == pytest.approx(100 * defects.forcing, abs=other_half + 1e-9)


def test_a_changed_cell_changes_what_is_printed(example):
    first, *others = example.tables.comparison
    changed = replace(first, integrated_rotation_ratio=0.123456789)
    tables = replace(example.tables, comparison=[changed, *others])
    data = record_data(example.record, example.accelerograms, example.structures, tables, SETTINGS)
    assert data["verdicts"][0]["table"]["rows"][0][4] == {"text": "0.123", "strong": True}


def test_every_number_in_a_sentence_stands_in_a_csv_or_counts_rows(example):
    data = record_data(*example.arguments)
    sentences = [*data["remarks"], *(line["names"] for line in data["headlines"])]
    sentences += [text for part in data["verdicts"] for text in part["sentences"]]
    assert sentences
    named, known = "|".join(map(re.escape, example.structures)), csv_numbers(example)
    for value, half in printed_numbers(" ".join(re.sub(named, "", text) for text in sentences)):
        assert np.abs(known - value).min() <= half * (1 + 1e-9), value


def test_page_one_begins_with_the_verdicts_by_name(example):
    data = record_data(*example.arguments)
    said = {line["verdict"].lower(): line["names"] for line in data["headlines"]}
    assert list(said) == [word for word in ("overturns", "undecided", "stands") if word in said]
    for row in example.tables.ensemble:
        assert row.structure in said[row.verdict]
        if row.verdict is Verdict.UNDECIDED:
            assert f"overturns in {row.overturning_members}\u00a0of\u00a0{row.members}" in said[row.verdict]
    assert len(data["fates"]["rows"]) == len(example.structures)


def test_a_band_on_a_strip_is_that_of_the_ensemble(example):
    data = record_data(*example.arguments)
    place = data["fates"]["heads"].index("5–95 %, of the critical rotation")
    for line, row in zip(data["fates"]["rows"], example.tables.ensemble, strict=True):
        ends = [row.rotation_ratio_low, row.rotation_ratio_median, row.rotation_ratio_high]
        assert line[place] == {
            "strip": [min(end, 1.0) for end in ends],
            "overturns": row.overturning_share,
        }


def test_what_stands_only_as_it_is_given_is_said_on_page_one(example):
    fallen = [
        replace(row, integrated_rotation_ratio=np.inf) if row.governs_record else row
        for row in example.tables.candidates
    ]
    still = [
        replace(row, integrated_rotation_ratio=0.2, answer_outcome=Outcome.ROCKS)
        for row in example.tables.comparison
    ]
    tables = replace(example.tables, candidates=fallen, comparison=still)
    data = record_data(example.record, example.accelerograms, example.structures, tables, SETTINGS)
    assert "another height of hinge or crack: wall 3 m (hinge at " in data["remarks"][0]


def test_the_worse_sign_of_the_motion_stands_on_page_one(example):
    turned = [replace(row, worst_polarity="reversed") for row in example.tables.ensemble]
    found = fate_lines(replace(example.tables, ensemble=turned), [])
    assert turned and all(line.fate.polarity == "reversed" for line in found)


def test_without_an_ensemble_page_one_says_what_the_single_run_does(example):
    tables = replace(example.tables, ensemble=[])
    data = record_data(example.record, example.accelerograms, example.structures, tables, SETTINGS)
    for row in tables.comparison:
        word = "Overturns" if np.isinf(row.integrated_rotation_ratio) else "Stands"
        assert any(
            line["verdict"].startswith(word) and row.structure in line["names"] for line in data["headlines"]
        )


def test_the_origin_names_version_file_and_time_of_the_record_and_no_time_of_the_run(example):
    timed = replace(
        example.tables, record=[replace(example.tables.record[0], start_time="1992-03-13T17:18:39")]
    )
    data = record_data(example.record, example.accelerograms, example.structures, timed, SETTINGS)
    assert data["origin"].startswith(
        "Recorded 1992-03-13T17:18:39. File: one.at2, SHA-256 abababababababab…. rocking "
    )


def test_the_same_input_gives_the_same_bytes(example):
    assert record_report(record_data(*example.arguments)) == record_report(record_data(*example.arguments))


def test_the_report_is_a_tagged_archive_document_of_two_to_six_pages(example):
    document = record_report(record_data(*example.arguments))
    assert document.startswith(b"%PDF-1.7")
    assert b"<pdfaid:part>2</pdfaid:part>" in document and b"<pdfaid:conformance>A" in document
    pages = max(int(count) for count in re.findall(rb"/Count (\d+)", document))
    assert 2 <= pages <= 6


def test_every_picture_has_an_alternative_text_and_no_type_under_seven_points(example):
    data = record_data(*example.arguments)
    pictures = [
        picture for many in ("motions", "maps", "drawings", "histories", "spectra") for picture in data[many]
    ]
    assert len(pictures) == 5
    for picture in pictures:
        assert len(picture["alt"]) > 20
        sizes = [each.size for each in texts(picture["svg"])]
        # sizes are whole units of 0.01 mm
        assert sizes and min(sizes) >= 7 - 0.02


def extracted(document: bytes) -> str:
    """The text of a PDF, without any white space."""
    if shutil.which("pdftotext") is None:
        pytest.skip(
            "pdftotext (poppler-utils) is not installed; it extracts the text of the PDF for this test"
        )
    run = subprocess.run(["pdftotext", "-raw", "-", "-"], input=document, capture_output=True, check=True)
    return "".join(run.stdout.decode().split())


def test_hostile_names_are_printed_as_they_are(hostile):
    document = record_report(record_data(*hostile.arguments))
    assert record_report(record_data(*hostile.arguments)) == document
    text = extracted(document)
    for name in HOSTILE:
        assert "".join(name.split()) in text, name


def test_the_declared_factor_stands_wherever_numbers_do(hostile):
    data = record_data(*hostile.arguments)
    assert "×\u00a012.5" in data["notices"][0]["text"] and data["notices"][0]["strong"]
    assert "×\u00a012.5" in data["running"]
    assert all("×\u00a012.5" in part["caption"] for part in data["verdicts"])
    assert extracted(record_report(record_data(*hostile.arguments))).count("×12.5") >= 10


def test_nothing_that_lifts_is_said_first():
    squat = {"squat": Block.of_size(2.0, 2.0)}
    data = record_data(*assessed("still", [shaken()], squat).arguments)
    assert any("No structure uplifts" in notice["text"] for notice in data["notices"])
    assert data["histories"] == []


def test_a_record_without_a_structure_still_gives_a_document():
    case = assessed("empty", [shaken()], {})
    assert "No structure could be assessed" in record_data(*case.arguments)["notices"][0]["text"]
    assert record_report(record_data(*case.arguments)).startswith(b"%PDF")


def test_a_record_without_a_pulse_still_gives_a_document():
    flat = Accelerogram(np.zeros(400), 0.01, "EW")
    case = assessed("flat", [flat], {"block": Block.of_size(1.0, 4.0)})
    data = record_data(*case.arguments)
    assert any("No pulse could be sought" in notice["text"] for notice in data["notices"])
    assert record_report(record_data(*case.arguments)).startswith(b"%PDF")


def test_a_hundred_structures_are_all_in_the_first_table_and_few_are_drawn(example):
    named = [f"block {place}" for place in range(100)]
    tables = replace(
        example.tables,
        comparison=[replace(example.tables.comparison[0], structure=name) for name in named],
        maxima=[],
        ensemble=[],
        candidates=[],
    )
    structures = {f"block {place}": example.structures["block 4 m"] for place in range(100)}
    data = record_data(example.record, example.accelerograms, structures, tables, SETTINGS)
    assert len(data["fates"]["rows"]) == len(data["verdicts"][0]["table"]["rows"]) == 100
    assert "and 88 others" in data["headlines"][0]["names"]
    assert "88 structures" in data["histories"][0]["note"]


@pytest.mark.parametrize("message", ["records/x.at2: #panic(1) $x^$ <b>.", "", "W" * 300])
def test_a_failure_is_one_page_that_says_why(message):
    document = failure_report("bad #record$", message)
    assert re.findall(rb"/Count (\d+)", document) == [b"1"]
    assert "".join(message.split()) in extracted(document)


def test_a_contact_that_fails_is_said_first(example):
    place, failing = next(
        (place, row)
        for place, row in enumerate(example.tables.maxima)
        if row.method is Method.MECHANISM_ON_RECORD
    )
    maxima = list(example.tables.maxima)
    maxima[place] = replace(failing, slides=True, bounces=True)
    tables = replace(example.tables, maxima=maxima)
    data = record_data(example.record, example.accelerograms, example.structures, tables, SETTINGS)
    said = f"{failing.structure} (slides and bounces)"
    assert any(said in notice["text"] and notice["strong"] for notice in data["notices"])
    assert data["trust"]["rows"][0][-1] == {"text": "slides and bounces", "strong": True}


def test_the_governing_height_is_the_one_that_the_table_marks(example):
    marked = [row for row in example.tables.candidates if row.governs_record]
    shown = record_data(*example.arguments)["candidates"]["rows"]
    assert [row[2] for row in shown] == [row.structure for row in marked] == ["wall 3 m"]
    # three significant digits
    assert float(shown[0][5]) == pytest.approx(marked[0].position_m, rel=5e-3)


def test_an_outcome_that_processing_decides_is_said(example):
    maxima = list(example.tables.maxima)
    place = next(k for k, row in enumerate(maxima) if row.structure == "arch 20 m" and row.processing)
    other = Outcome.ROCKS if maxima[place].outcome is Outcome.OVERTURNS else Outcome.OVERTURNS
    other_ratio = 0.3 if other is Outcome.ROCKS else np.inf
    maxima[place] = replace(maxima[place], outcome=other, rotation_ratio=other_ratio)
    tables = replace(example.tables, maxima=maxima)
    data = record_data(example.record, example.accelerograms, example.structures, tables, SETTINGS)
    said = [text for text in data["remarks"] if "depends on the processing" in text]
    assert "arch 20 m" in said[0]


def test_a_vertical_component_is_named_and_changes_the_histories(example):
    up = Accelerogram(3 * np.sin(np.arange(2000) * 0.1), 0.01, "UP", vertical=True)
    acting = {"vertical_component": "UP", "vertical_peak_acceleration_m_s2": 2.999}
    tables = replace(example.tables, record=[replace(example.tables.record[0], **acting)])
    arguments = (example.record, example.accelerograms, example.structures, tables, SETTINGS)
    still, moved = record_data(*arguments), record_data(*arguments, vertical=up)
    assert "vertical component UP acts" in still["vertical"]
    assert still["histories"][0]["svg"] != moved["histories"][0]["svg"]
    assert record_data(*example.arguments)["vertical"] == "The vertical ground acceleration is left out."


def test_the_first_lines_hold_few_long_names_and_say_how_many_more(example):
    many = {f"{place} {'W' * 60}": example.tables.comparison[0] for place in range(12)}
    comparison = [replace(row, structure=name) for name, row in many.items()]
    tables = replace(example.tables, comparison=comparison, ensemble=[], candidates=[], maxima=[])
    (line,) = headlines(fate_lines(tables, []))
    assert len(line["names"]) < 340 and line["names"].endswith("and eight others")
