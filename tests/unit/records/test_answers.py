"""An answer of layouts.csv holds for files like the one it was drawn from, and never against their own page."""

import csv
from pathlib import Path

import numpy as np
import pytest

from rocking.catalogue.folder import catalogue_of_folder
from rocking.errors import RecordError
from rocking.records import read
from rocking.records.formats.layouts import (
    NAME,
    AskedError,
    Layouts,
    Question,
    Signature,
    TableLayout,
    families,
)
from rocking.records.kinds import RecordKind
from tests.folders import list_folder
from tests.refusals import refused
from tests.unit.records.test_layouts import MOTION, OTHER, TIMES, UP, answer_all, answered, table, wrapped

G = 9.80665
SHAPE = MOTION / np.abs(MOTION).max()


def pairs(peak: float, step: float = 0.01) -> str:
    return table(step * np.arange(600), peak * SHAPE, digits=".7g")


def asked_rows(folder: Path) -> list[dict[str, str]]:
    """The rows of layouts.csv that the files of a folder ask for."""
    content = catalogue_of_folder(folder).layouts
    return [] if content is None else list(csv.DictReader(content.splitlines()))


def write_asked(folder: Path) -> None:
    content = catalogue_of_folder(folder).layouts
    assert content is not None
    (folder / NAME).write_text(content)


MIXED = [*np.geomspace(0.35, 0.98, 9), *np.geomspace(5, 14, 9), *np.geomspace(79, 230, 5)]
"""Peaks of 23 files of one folder, in three units."""


def test_a_folder_of_three_units_is_asked_three_times_and_each_question_tells_the_others(
    tmp_path: Path,
) -> None:
    for place, peak in enumerate(MIXED):
        (tmp_path / f"{place:02}.txt").write_text(pairs(peak))
    rows = asked_rows(tmp_path)
    assert [row["peaks"] for row in rows] == ["0.35..0.98", "5..14", "79..230"]
    assert [row["holds"].partition("600 rows; ")[2] for row in rows] == [
        "9 of 23 files with peaks 0.35–0.98 (the others: 9 of 5–14, 5 of 79–230)",
        "9 of 23 files with peaks 5–14 (the others: 9 of 0.35–0.98, 5 of 79–230)",
        "5 of 23 files with peaks 79–230 (the others: 9 of 0.35–0.98, 9 of 5–14)",
    ]
    write_asked(tmp_path)
    answer_all(tmp_path, {"00.txt": "t, a m/s2", "09.txt": "t, a", "18.txt": "t, a gal"})
    read_as = {file.file: file for file in list_folder(tmp_path)[0]}
    assert all(not read_as[f"{place:02}.txt"].refusal for place in range(9))
    assert all(read_as[f"{place:02}.txt"].blanks == ("unit",) for place in range(9, 18))
    for place, peak in enumerate(MIXED[18:], 18):
        (channel,) = read(tmp_path / f"{place:02}.txt")
        assert channel.peak_acceleration == pytest.approx(peak / 100, rel=1e-5)
    for place, peak in enumerate(MIXED[:9]):
        (channel,) = read(tmp_path / f"{place:02}.txt")
        assert channel.peak_acceleration == pytest.approx(peak, rel=1e-5)


@pytest.mark.parametrize("like", [
    ("b.txt", 0.02, 0.01), ("b.txt", 4.0, 0.01), ("b.txt", 0.3, 0.005), ("b.dat", 0.3, 0.01), ("b", 0.3, 0.01),
])  # fmt: skip
def test_an_answer_does_not_hold_for_another_peak_step_or_ending(
    tmp_path: Path, like: tuple[str, float, float]
) -> None:
    (tmp_path / "a.txt").write_text(pairs(0.3))
    write_asked(tmp_path)
    answer_all(tmp_path, {"a.txt": "t, a g"})
    name, peak, step = like
    (tmp_path / name).write_text(pairs(peak, step))
    assert read(tmp_path / "a.txt")[0].peak_acceleration == pytest.approx(0.3 * G, rel=1e-5)
    with pytest.raises(AskedError):
        read(tmp_path / name)
    (tmp_path / "c.txt").write_text(pairs(0.5))  # within the root of three
    assert read(tmp_path / "c.txt")[0].peak_acceleration == pytest.approx(0.5 * G, rel=1e-5)


def test_one_series_asks_by_its_peak_too(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text(wrapped(0.2 * SHAPE, 5))
    (tmp_path / "b.txt").write_text(wrapped(150 * SHAPE, 5))
    assert [row["peaks"] for row in asked_rows(tmp_path)] == ["0.2", "150"]


def test_names_without_a_unit_ask_by_their_peaks_and_names_with_one_do_not(tmp_path: Path) -> None:
    for place, peak in enumerate((0.3, 300.0)):
        (tmp_path / f"{place}.csv").write_text("Time,Q1\n" + pairs(peak).replace(" ", ","))
        (tmp_path / f"named{place}.csv").write_text("units: gal\nTime,Q1\n" + pairs(peak).replace(" ", ","))
    rows = asked_rows(tmp_path)
    assert [(row["file"], row["peaks"]) for row in rows] == [
        ("0.csv", "0.3"),
        ("1.csv", "300"),
        ("named0.csv", ""),
    ]


def question(peaks: str) -> Question:
    return Question(Signature("", "2", "", "", ".txt", "0.01", peaks), "x", "t, ?")


def test_families_part_at_three_times_the_least_peak() -> None:
    """g and m/s² are 9.81 apart."""
    peaks = ["3", "0.1", "0.29", "1.01", "11", "0", ""]
    found = families((peak, question(peak)) for peak in peaks)
    assert {frozenset(family.files) for family in found} == {
        frozenset(names) for names in [("0", ""), ("0.1", "0.29"), ("3", "1.01"), ("11",)]
    }


@pytest.mark.parametrize(("row", "file", "holds"), [
    ("0.35..1", "0.35", True), ("0.35..1", "1", True), ("0.35..1", "1.02", True), ("0.35..1", "1.03", False),
    ("0.35..1", "0.34", False), ("0.9", "1.55", True), ("0.9", "1.57", False), ("0.9", "0.51", False),
    ("", "0.9", False), ("0,35..1,0", "0.9", True), ("0", "0", True), ("0", "1", False), ("nonsense", "1", False),
])  # fmt: skip
def test_a_row_holds_for_the_root_of_three_about_the_middle_of_its_peaks(
    row: str, file: str, holds: bool
) -> None:
    assert (question(row).signature.distance(question(file).signature) is not None) is holds


def test_two_answers_for_one_file_are_told_and_cost_the_others_nothing(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text(pairs(0.3))
    (tmp_path / "b.txt").write_text(pairs(90))
    write_asked(tmp_path)
    answer_all(tmp_path, {"a.txt": "t, a g", "b.txt": "t, a gal"})
    rows = list(csv.DictReader((tmp_path / NAME).read_text().splitlines()))
    with (tmp_path / NAME).open("a") as stream:
        csv.DictWriter(stream, rows[0]).writerow(rows[0] | {"answer": "t, a m/s2"})
    with refused(RecordError, "answer", ("t, a g", "t, a m/s2")):
        read(tmp_path / "a.txt")
    files = {file.file: file for file in list_folder(tmp_path)[0]}
    assert files["a.txt"].refusal and not files["b.txt"].refusal


def test_an_answer_that_fits_no_file_of_its_folder_is_told(tmp_path: Path) -> None:
    (tmp_path / "a.txt").write_text(pairs(0.3))
    write_asked(tmp_path)
    answer_all(tmp_path, {"a.txt": "t, a g"})
    assert not catalogue_of_folder(tmp_path).warnings
    (tmp_path / "a.txt").write_text(pairs(90))
    (warning,) = catalogue_of_folder(tmp_path).warnings
    assert warning.kind is RecordKind.ANSWER_IDLE and warning["line"] == 2 and warning["answer"] == "t, a g"


def test_no_ground_moves_at_more_than_four_metres_a_second(tmp_path: Path) -> None:
    """One cycle of a sine of amplitude a and period T moves at a·T/π, and a high-pass takes a part of that away."""
    times = 0.01 * np.arange(2000)
    cycle = np.where((times > 8) & (times < 9.5), np.sin(2 * np.pi * (times - 8) / 1.5), 0.0)
    for velocity, kinds in ((2.0, set()), (3.6, {RecordKind.VELOCITY_RARE})):
        (tmp_path / "a.csv").write_text(
            "t,NS (m/s2)\n" + table(times, velocity * np.pi / 1.5 * cycle, parted=",")
        )
        assert {warning.kind for warning in read(tmp_path / "a.csv")[0].warnings} == kinds
    (tmp_path / "a.csv").write_text("t,NS (g)\n" + table(times, 2 * np.pi / 1.5 * cycle, parted=","))
    with refused(RecordError, "peak", "peak velocity is 16.6 m/s"):
        read(tmp_path / "a.csv")
    # An offset of the recorder, 0.1 m/s² for 200 s, moves no ground.
    still = 0.1 + 0.3 * np.sin(30 * 0.01 * np.arange(20_000))
    (tmp_path / "b.csv").write_text("t,NS (m/s2)\n" + table(0.01 * np.arange(20_000), still, parted=","))
    assert not read(tmp_path / "b.csv")[0].warnings


PAGE = "Station MADE\nunits: cm/s^2, sampled at 100 Hz\n"


def test_what_the_page_says_is_proposed_and_held_against_an_answer(tmp_path: Path) -> None:
    path = tmp_path / "made.txt"
    path.write_text(PAGE + table(100 * MOTION, 100 * OTHER, 100 * UP))
    with pytest.raises(AskedError) as asked:
        read(path)
    assert asked.value.question.proposal == "? cm/s2, ? cm/s2, ? cm/s2"
    for answer in ("E g, N g, Z g", "E cm/s2, N cm/s2, Z cm/s2, dt .005"):
        (tmp_path / NAME).unlink(missing_ok=True)
        answered(tmp_path, asked.value.question, answer)
        with refused(RecordError, "answer", answer):
            read(path)
    for answer in ("E cm/s2, N cm/s2, Z cm/s2", "E, N, Z", "E gal, N gal, Z gal, dt .01"):
        (tmp_path / NAME).unlink()
        answered(tmp_path, asked.value.question, answer)
        east, north, up = read(path)
        assert (east.azimuth, north.azimuth, up.vertical, up.time_step) == (90.0, 0.0, True, 0.01)
        assert north.acceleration == pytest.approx(OTHER, abs=1e-7)


@pytest.mark.parametrize(("head", "answer", "named"), [
    ("time,NS,EW\n", "t, EW g, NS g", ("answer", 't, EW g, NS g')),
    ("time,acc,vel\n", "t, a g, N g", ("answer", 't, a g, N g')),
    ("", "N g, EW g, NS g", ("answer", 'N g, EW g, NS g')),
    ("# rate: 200 samples per second, 3 channels\n", "t, N g, E g, dt 0.005", ("answer", 't, N g, E g, dt 0.005')),
    ("Unit,gal\n", "t, N mg, E mg", ("answer", 't, N mg, E mg')),
])  # fmt: skip
def test_an_answer_against_the_names_the_text_or_the_numbers_is_refused(
    tmp_path: Path, head: str, answer: str, named: tuple
) -> None:
    path = tmp_path / "made.txt"
    path.write_text(head + table(TIMES, 0.2 * MOTION, 0.2 * OTHER, parted=","))
    layouts = Layouts(tmp_path)
    listing = catalogue_of_folder(tmp_path).files[0]
    if listing.question is None:  # its unit alone is open
        with pytest.raises(AskedError) as asked:
            read(path)
        asking = asked.value.question
    else:
        asking = listing.question
    assert layouts.text([("made.txt", asking)])
    answered(tmp_path, asking, answer)
    with refused(RecordError, *named):
        read(path)


@pytest.mark.parametrize(("answer", "columns"), [
    ("t, g", "t, a g"), ("time, acc g", "t, a g"), ("Time, m/s2", "t, a m/s2"),
    ("times ms, acceleration gal", "t ms, a gal"), ("g, g, g", "a g, a g, a g"),
])  # fmt: skip
def test_a_unit_is_no_name_of_a_component_and_time_no_direction(answer: str, columns: str) -> None:
    layout = TableLayout.parse(answer)
    assert str(layout) == columns
    assert not any(column.name for column in layout.columns)


@pytest.mark.parametrize("answer", ["t, vel g", "t, a g, disp g", "velocity, a g"])
def test_velocity_and_displacement_are_no_components(answer: str) -> None:
    with refused(RecordError, "answer"):
        TableLayout.parse(answer)


TAILS = [
    "*** End Data ***",
    "LEE $",
    "/* last line */",
    "Processed by the office of the town\nSheet one",
    "Fin.",
]


@pytest.mark.parametrize("tail", TAILS)
def test_text_below_the_numbers_is_a_tail(tmp_path: Path, tail: str) -> None:
    path = tmp_path / "made.csv"
    path.write_text("t,NS acc (m/s2)\n" + table(TIMES, MOTION, parted=",") + tail + "\n")
    (record,) = read(path)
    assert record.acceleration == pytest.approx(MOTION, abs=1e-6)
    is_said = tail in TAILS[2:]
    assert [warning.kind for warning in record.warnings] == ([RecordKind.TAIL_PASSED_OVER] if is_said else [])
    bare = tmp_path / "bare.txt"
    bare.write_text(wrapped(MOTION, 5) + tail)
    with pytest.raises(AskedError) as asked:
        read(bare)
    assert (tail.split("\n")[0] in asked.value.question.holds) is is_said
    answered(tmp_path, asked.value.question, "one series m/s2, 5 a line, dt 0.01")
    assert read(bare)[0].acceleration == pytest.approx(MOTION, abs=1e-6)


def test_a_tail_that_states_a_unit_is_part_of_the_page(tmp_path: Path) -> None:
    path = tmp_path / "made.txt"
    path.write_text(table(TIMES, 100 * MOTION) + "units: gal\n")
    (record,) = read(path)
    assert record.acceleration == pytest.approx(MOTION, abs=1e-6)
    with refused(RecordError, "unit", "g"):
        read(path, unit="g")


@pytest.mark.parametrize("tail", ["6.01 x", "nan 0.1", "6.0x 0.1", "0.1 0.2 0.3", "12.5"])
def test_a_damaged_row_at_the_end_is_no_tail(tmp_path: Path, tail: str) -> None:
    path = tmp_path / "made.csv"
    path.write_text("t NS(m/s2)\n" + table(TIMES, MOTION) + tail + "\n")
    with pytest.raises(RecordError):
        read(path)


@pytest.mark.parametrize(("head", "step"), [
    ("dt = 5.E-03", 0.005), ("DT= .5E-2 SEC", 0.005), ("sampling rate: 100. Hz", 0.01), ("sampled at 1e2 Hz", 0.01),
    ("Sampling frequency = 200.0 Hz; low-pass filtered at 25 Hz", 0.005),
    ("fs = 100 Hz\nband-pass 0.1 Hz - 40 Hz", 0.01),
])  # fmt: skip
def test_numbers_of_heads_are_those_of_rows(tmp_path: Path, head: str, step: float) -> None:
    path = tmp_path / "made.txt"
    path.write_text("".join(f"# {line}\n" for line in [*head.split("\n"), "units: m/s2"]) + table(MOTION))
    (record,) = read(path)
    assert record.time_step == pytest.approx(step, rel=1e-12)


@pytest.mark.parametrize("head", [
    "sampling rate: 200 Hz, resampled to 100 Hz", "sampled at 200 Hz\nsampling rate = 100 Hz",
    "dt = 0.005\nsampling rate: 100 Hz", "dt = 0.01 s\ndecimated from 200 sps",
])  # fmt: skip
def test_two_rates_in_a_head_are_asked(tmp_path: Path, head: str) -> None:
    path = tmp_path / "made.txt"
    path.write_text("".join(f"# {line}\n" for line in [*head.split("\n"), "units: m/s2"]) + table(MOTION))
    with pytest.raises(AskedError) as asked:
        read(path)
    assert asked.value.field == "time_step"
    answered(tmp_path, asked.value.question, "one series m/s2, dt 0.01")
    assert read(path)[0].time_step == 0.01
    (tmp_path / NAME).unlink()
    answered(tmp_path, asked.value.question, "one series m/s2, dt 0.02")
    with refused(RecordError, "answer", "one series m/s2, dt 0.02"):
        read(path)


@pytest.mark.parametrize(("peaks", "answer", "why"), [
    ((0.3, 0.35), "t, a cm/s2", "2 of its 2 files would be below 0.001 g"),
    ((2.2, 2.9), "t, a g", "2 of its 2 files would be above 1 g"),
    ((2.2, 2.9, 6.0), "t, a g", "3 of its 3 files would be above 1 g"),
])  # fmt: skip
def test_files_that_an_answer_makes_too_weak_or_too_strong_open_it_again(
    tmp_path: Path, peaks: tuple[float, ...], answer: str, why: str
) -> None:
    """One that is refused for its peak alone counts with the others."""
    for place, peak in enumerate(peaks):
        (tmp_path / f"{place}.txt").write_text(pairs(peak))
    write_asked(tmp_path)
    answer_all(tmp_path, {"0.txt": answer})
    catalogue = catalogue_of_folder(tmp_path)
    assert all(file.refusal for file in catalogue.files) and why in catalogue.files[0].refusal
    assert f"? {answer}" in (catalogue.layouts or "")


def test_an_answer_is_tried_on_all_its_files_before_it_counts(tmp_path: Path) -> None:
    """Files of 1.1 to 2 m/s² are no records in g; the one of .35 g next to them is of a line of its own."""
    for place, peak in enumerate((0.35, *np.geomspace(1.1, 2.0, 7))):
        (tmp_path / f"{place}.txt").write_text(pairs(peak))
    write_asked(tmp_path)
    answer_all(tmp_path, {"0.txt": "t, a g", "1.txt": "t, a g"})
    catalogue = catalogue_of_folder(tmp_path)
    assert [bool(file.refusal) for file in catalogue.files] == [False] + 7 * [True]
    assert "7 of its 7 files would be above 1 g" in catalogue.files[1].refusal
    assert catalogue.layouts is not None
    (tmp_path / NAME).write_text(catalogue.layouts)
    rows = {row["file"]: row for row in csv.DictReader(catalogue.layouts.splitlines())}
    assert (rows["0.txt"]["answer"], rows["0.txt"]["tried"]) == ("t, a g", "1 file, 0.35–0.35 g")
    assert rows["1.txt"]["answer"] == "? t, a g" and "would be above 1 g" in rows["1.txt"]["tried"]
    assert read(tmp_path / "0.txt")  # and at every other door the answer is open again
    with pytest.raises(AskedError):
        read(tmp_path / "1.txt")
    answer_all(tmp_path, {"1.txt": "t, a g"})  # a person insists
    again = catalogue_of_folder(tmp_path)
    assert not any(file.refusal for file in again.files) and again.layouts is None
    rows["1.txt"]["answer"] = "t, a m/s2"
    with (tmp_path / NAME).open("w") as stream:
        writer = csv.DictWriter(stream, list(rows["1.txt"]))
        writer.writeheader()
        writer.writerows(rows.values())
    assert read(tmp_path / "7.txt")[0].peak_acceleration == pytest.approx(2.0, rel=1e-4)
    assert "7 files, 0.112–0.204 g" in (catalogue_of_folder(tmp_path).layouts or "")
