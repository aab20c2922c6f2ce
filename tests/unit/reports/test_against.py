"""Page two: prediction against integration. Its numbers are those of the tables, and its lines are where they say."""

import csv
import math
import re
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from rocking.assessment.rows import ComparisonRow, PulseRow
from rocking.reports.against import HEIGHT, MOST_STRIPS, WIDTH, in_words
from rocking.reports.pages import Against, Compared
from rocking.reports.record import RecordReport
from rocking.structures import Block
from rocking.tables import write_rows

from .conftest import assessed, of_structures, pages, shaken

REACH = 1.25
"""Rotation ratio at both edges of a strip."""


@pytest.fixture(scope="module")
def blocks() -> list[RecordReport]:
    """24 blocks of random sizes under each of three motions; some overturn, some rest."""
    random = np.random.default_rng(65)
    made = {
        f"block {place}": Block.of_size(*sizes)
        for place, sizes in enumerate(random.uniform((0.3, 2), (1.4, 6), (24, 2)))
    }
    motions = [[shaken("EW")], [shaken("NS", 1.6), shaken("East", 1.6)], [shaken("Z" * 7, 0.7)]]
    return [assessed(f"record {place}", motion, made) for place, motion in enumerate(motions)]


def cells(report: RecordReport, folder, kind=ComparisonRow) -> list[dict[str, str]]:
    path = folder / f"{kind.table.name}.csv"
    write_rows(kind, {ComparisonRow: report.tables.comparison, PulseRow: report.tables.pulses}[kind], path)
    with path.open(encoding="utf-8", newline="") as stream:
        return list(csv.DictReader(stream))


def against_of(report: RecordReport) -> Against:
    (page,) = report.page().against
    return page


def worst_of(rows: list[dict[str, str]], structure: str) -> dict[str, str]:
    own = [row for row in rows if row["structure"] == structure]
    return max(own, key=lambda row: float(row["integrated_rotation_ratio"]))


def is_printed(text: str, cell: str) -> bool:
    """Whether a text of the page is a cell of a table, to its own digits."""
    value = float(cell) if cell else math.nan
    if text in ("falls", "rests", "–"):
        return text == in_words(value)
    number = float(text.replace("−", "-"))
    digits = len(text.partition(".")[2])
    return abs(number - value) <= 0.5 * 10.0**-digits * (1 + 1e-9)


CONSTANTS = ("uplift_multiplier", "frequency_parameter_rad_s", "critical_rotation_rad", "restitution")


def test_every_number_of_the_page_is_a_cell_of_comparison_csv(blocks, example, tmp_path):
    """Of the component that turns a structure farthest, and of the crack of that row."""
    checked = 0
    for report in (*blocks, example):
        rows = cells(report, tmp_path)
        for compared in against_of(report).compared:
            row = worst_of(rows, compared.name)
            of_methods = (
                (compared.printed, "printed_rotation_ratio"),
                (compared.form, "predicted_rotation_ratio"),
                (compared.whole, "integrated_rotation_ratio"),
            )
            assert all(is_printed(text, row[name]) for text, name in of_methods), compared.name
            constants = [text.partition(" ")[2] for text in compared.constants]
            assert all(is_printed(*pair) for pair in zip(constants, map(row.get, CONSTANTS), strict=True))
            assert compared.outside == (row["printed_holds"] == "false")
            assert row["crack"] in compared.note
            of_component = f"under {row['component']}" in compared.note.split(", ")
            assert of_component == (len(report.motions) > 1)
            checked += 3 + len(constants)
    assert checked >= 300


def test_the_sine_of_the_page_is_that_of_pulses_csv(blocks, tmp_path):
    for report in blocks:
        of_component = {
            row["component"]: row
            for row in cells(report, tmp_path, PulseRow)
            if row["rank"] == "1" and row["kind"] == "alternative"
        }
        for ground in against_of(report).grounds:
            row = of_component[ground.name]
            amplitude, period, onset, energy = re.findall(r"[\d.]+(?=\u00a0| m)", " ".join(ground.facts))
            assert is_printed(amplitude, str(abs(float(row["amplitude_m_s2"]))))
            assert is_printed(period, row["period_s"]) and is_printed(onset, row["start_time_s"])
            assert is_printed(energy, str(100 * float(row["explained_energy"])))


def lines_of(compared: Compared, look: str) -> list[np.ndarray]:
    """The lines of a strip whose look holds a text: across in mm, and upwards as a rotation ratio."""
    found = re.findall(rf'<polyline points="([^"]*)"[^>]*{look}', compared.picture.svg)
    drawn = [np.array([list(map(float, pair.split(","))) for pair in item.split()]) for item in found]
    return [np.column_stack([line[:, 0], REACH * (1 - 2 * line[:, 1] / HEIGHT)]) for line in drawn]


def test_the_history_reaches_what_the_number_says_and_the_band_what_the_closed_form_says(blocks):
    seen = set()
    for report in blocks:
        by_name = {conclusion.row.structure: conclusion.case for conclusion in report.conclusions}
        for compared in against_of(report).compared:
            case = by_name[compared.name]
            (history,) = lines_of(compared, 'stroke="black" stroke-width="0.28"')
            assert history[:, 0].min() >= 0 and history[:, 0].max() <= WIDTH + 1e-3
            largest = min(case.integrated_rotation_ratio, REACH)
            assert np.abs(history[:, 1]).max() == pytest.approx(largest, abs=2e-3)
            assert ("<polygon" in compared.picture.svg) == math.isinf(case.integrated_rotation_ratio)
            form = lines_of(compared, 'stroke="#0072B2"')
            if 0 < case.predicted_rotation_ratio <= REACH:
                levels = sorted(line[0, 1] for line in form)
                assert levels == pytest.approx(
                    [-case.predicted_rotation_ratio, case.predicted_rotation_ratio], abs=1e-3
                )
            dotted = lines_of(compared, "stroke-dasharray")
            assert bool(dotted) == (0 < case.printed_rotation_ratio <= REACH)
            seen.add((compared.whole == "falls", compared.form == "falls", compared.printed == "falls"))
    assert len(seen) >= 4


def test_axes_have_a_few_round_numbers_where_these_are(blocks):
    for report in blocks:
        page = against_of(report)
        for ticks in (page.ticks, *(ground.levels for ground in page.grounds)):
            at = [tick.at for tick in ticks]
            numbers = [float(tick.label.replace("−", "-").partition(" ")[0]) for tick in ticks]
            assert (
                2 <= len(ticks) <= 7 and np.ptp(at - np.polyval(np.polyfit(numbers, at, 1), numbers)) < 1e-6
            )
            steps = {f"{abs(one - other):.4g}" for one, other in pairwise(numbers)}
            assert all(step.strip("0.")[:1] in "1245" for step in steps), steps


def test_those_at_rest_stand_in_one_line_and_have_no_strip(blocks):
    for report in blocks:
        page = against_of(report)
        resting = {
            conclusion.row.structure for conclusion in report.conclusions if conclusion.ratios[-1] <= 1e-3
        }
        assert {row.name for row in page.compared} | resting == set(report.structures)
        assert not resting & {one_row.name for one_row in page.compared}
        assert all(re.search(rf"\b{name}\b", page.at_rest) for name in resting)


def test_the_worst_comes_first_as_on_page_one(blocks):
    for report in blocks:
        order = [conclusion.row.structure for conclusion in report.conclusions]
        names = [row.name for row in against_of(report).compared]
        assert names == [name for name in order if name in names]


@pytest.mark.process
def test_the_printed_page_holds_the_numbers_in_the_row_of_their_structure(blocks):
    """Read from the PDF: right of each name, and at its height."""
    report = blocks[0]
    _, *printed, _ = pages(report.pdf())
    read = 0
    for compared in against_of(report).compared:
        number = compared.name.split()[1]
        words, top = next(
            (words, one[1])
            for words in printed
            for one, two in pairwise(words)
            if (one[4], two[4]) == ("block", number) and one[0] < 60
        )
        of_row = [word[4] for word in words if word[0] > 380 and top - 12 < word[1] < top + 32]
        for text in (compared.printed, compared.form, compared.whole):
            assert text in of_row, (compared.name, of_row)
            read += 1
    assert read >= 30


@pytest.mark.process
@pytest.mark.parametrize(("count", "of_pages"), [(1, 2), (12, 3), (20, 3), (60, 4)])
def test_twelve_structures_fit_a_page_and_more_go_on(example, count, of_pages):
    report = of_structures(example, {f"block {place}": "block 4 m" for place in range(count)})
    page = against_of(report)
    assert len(page.compared) == min(count, MOST_STRIPS)
    assert page.more == (
        "" if count <= MOST_STRIPS else f"Another {count - MOST_STRIPS} structures in comparison.csv."
    )
    printed = pages(report.pdf())
    assert len(printed) == of_pages
    names = [sum(word[4] == "block" and word[0] < 60 for word in page) for page in printed]
    assert names[1] >= min(count, 12)


@pytest.mark.process
def test_where_nothing_moves_the_page_has_the_ground_and_one_line(example):
    squat = {"squat block": example.structures["squat block"]}
    report = of_structures(example, dict.fromkeys(squat, "squat block"))
    page = against_of(report)
    assert page.compared == () and page.ticks and len(page.grounds) == 1
    assert page.at_rest == "At rest under the record: squat block."
    printed = pages(report.pdf())
    assert len(printed) == 2
    assert not any(word[4] == "Dotted:" for word in printed[1]), "there are no strips to explain"


def test_a_structure_that_cannot_be_drawn_costs_no_other_its_strip(example, monkeypatch):
    def fails(name, structure):
        if name == "block 4 m":
            raise ZeroDivisionError("of a structure")
        return name

    whole = {row.name for row in against_of(example).compared}
    monkeypatch.setattr("rocking.reports.against.sizes_of", fails)
    assert {one_row.name for one_row in against_of(example).compared} == whole - {"block 4 m"}


def test_without_a_sine_the_closed_forms_are_dashes(example):
    none = {"printed_rotation_ratio": math.nan, "predicted_rotation_ratio": math.nan, "printed_holds": None}
    rows = [replace(row, **none) for row in example.tables.comparison]
    bare = replace(example, tables=replace(example.tables, comparison=rows, pulses=()))
    assert {(one_row.printed, one_row.form) for one_row in against_of(bare).compared} == {("–", "–")}
    assert [ground.facts for ground in against_of(bare).grounds] == [()]


def test_a_rotation_below_zero_is_none():
    """Eq. 15 gives one where it does not hold."""
    assert in_words(-3.7) == in_words(math.nan) != in_words(0.0) == "rests"
