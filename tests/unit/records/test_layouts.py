"""Layouts: what a table leaves open is asked once, answered in layouts.csv, and read by the answer ever after."""

import csv
import re
from pathlib import Path

import numpy as np
import pytest

from rocking.catalogue import load_catalogue, open_station
from rocking.catalogue.files import answers_of
from rocking.errors import CatalogueError, RecordError
from rocking.records import read
from rocking.records.formats.layouts import COLUMNS, NAME, AskedError, Layouts, Question, TableLayout
from rocking.records.kinds import RecordKind
from rocking.study.workspace import write_catalogue
from tests.folders import list_folder
from tests.refusals import refused

TIMES = 0.01 * np.arange(600)
MOTION = np.sin(7.3 * TIMES) * np.exp(-0.4 * TIMES) + 0.2 * np.sin(31 * TIMES + 1)
OTHER = np.roll(MOTION, 170)
UP = 0.6 * np.roll(MOTION, 330)


def answered(folder: Path, question: Question, answer: str) -> None:
    """Write layouts.csv with the answer to a question, as a person does who edits the line that is asked."""
    content = Layouts(folder).text([("made.txt", question)])
    assert content is not None
    rows = list(csv.DictReader(content.splitlines()))
    rows[-1]["answer"] = answer
    with (folder / NAME).open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)


def answer_all(folder: Path, answers: dict[str, str]) -> int:
    """Answer every open line of layouts.csv by the file that it was drawn from, and return how many there were."""
    path = folder / NAME
    rows = list(csv.DictReader(path.read_text(encoding="utf-8").splitlines()))
    asked = [row for row in rows if "?" in row["answer"]]
    for row in asked:
        row["answer"] = answers[row["file"]]
    with path.open("w", newline="", encoding="utf-8") as stream:
        writer = csv.DictWriter(stream, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)
    return len(asked)


def table(*columns: np.ndarray, parted: str = " ", digits: str = ".6f") -> str:
    return "".join(parted.join(f"{value:{digits}}" for value in row) + "\n" for row in np.transpose(columns))


def wrapped(numbers: np.ndarray, per_line: int, digits: str = "10.6f", parted: str = " ") -> str:
    cells = [f"{value:{digits}}" for value in numbers]
    return "\n".join(parted.join(cells[at : at + per_line]) for at in range(0, len(cells), per_line)) + "\n"


G = 9.80665
SHAKE = (
    "Source File: {name}\nSHAKE2000 Conversion:  600  0.01  5  8  9  (8f9.6)\n"
    "Acceleration Units: (g's) - No. Values: 600 - Time Step: 0.01 (secs)\n"
    "Data Format: 8f9.6 - No. Header Lines:  5\nSEISME HORIZONTAL\n"
)
STRATA = "# Strata OUTPUT -- Response -- 0 (Outcrop) -- Acceleration Time Series -- {name}\n# A site\n# Time (s),S-1\n"

MADE: dict[str, tuple[str, str, list[np.ndarray]]] = {
    "bare column": (table(MOTION), "one series m/s2, dt 0.01", [MOTION]),
    "five a line": (wrapped(MOTION, 5), "one series m/s2, 5 a line, dt 0.01", [MOTION]),
    "eight a line with commas": (
        wrapped(MOTION, 8, ".6f", ","),
        "one series m/s2, 8 a line, dt 0.01",
        [MOTION],
    ),
    "count and step first": ("600 0.01\n" + wrapped(MOTION, 8), "one series m/s2", [MOTION]),
    "one and step first": ("1\n0.01\n" + table(0.1 * MOTION), "-, dt, one series m/s2", [0.1 * MOTION]),
    "step and count first": ("0.01\n600\n" + table(MOTION), "dt, n, one series m/s2", [MOTION]),
    "count and rate first": ("600\n100\n" + table(MOTION), "n, hz, one series m/s2", [MOTION]),
    "times and accelerations": (table(TIMES, MOTION), "t, a m/s2", [MOTION]),
    "milliseconds": (table(1000 * TIMES, MOTION), "t ms, a m/s2", [MOTION]),
    "decimal commas": (table(TIMES, MOTION, parted=";").replace(".", ","), "t, a m/s2", [MOTION]),
    "three and times": (table(TIMES, MOTION, OTHER, UP), "t, NS, EW, UD m/s2", [MOTION, OTHER, UP]),
    "three without times": (table(MOTION, OTHER, UP), "NS, EW, UD m/s2, dt 0.01", [MOTION, OTHER, UP]),
    "a time column each": (table(TIMES, MOTION, TIMES, OTHER), "t, NS, t, EW m/s2", [MOTION, OTHER]),
    "pairs along the rows": (
        table(*np.transpose([TIMES, MOTION]).reshape(-1, 4).T),
        "t, a m/s2, 4 a line",
        [MOTION],
    ),
    "velocity beside": (
        "t a v\n" + table(TIMES, MOTION, np.cumsum(MOTION) * 0.01),
        "t, a m/s2, -",
        [MOTION],
    ),
    "names of nobody": ("Time,Q1,Q2\n" + table(TIMES, MOTION, OTHER, parted=","), "t, -, a m/s2", [OTHER]),
    "a sensor of six axes": (
        "t,ax,ay,az,gx\n" + table(TIMES, MOTION, OTHER, UP, UP, parted=","),
        "t, X m/s2, Y m/s2, Z m/s2, -",
        [MOTION, OTHER, UP],
    ),
    "multiplied": ("t (s);acc x1e-3 (g)\n" + table(TIMES, MOTION * 1e3 / G, parted=";"), "t, a mg", [MOTION]),
    "a header of whole numbers": (
        "1940 5 18 600 77\n" + wrapped(MOTION, 5),
        "one series m/s2, 5 a line, skip 1, dt 0.01",
        [MOTION],
    ),
    "text with keys": ("Station = X\nk = 7\n" + table(MOTION), "one series m/s2, dt 0.01", [MOTION]),
    "a title and a factor": (
        "El Centro\nscale factor 1\n" + wrapped(MOTION, 8),
        "one series m/s2, dt 0.01",
        [MOTION],
    ),
    "numbers that touch": (
        wrapped(1e3 * MOTION, 10, "8.2f", ""),
        "one series mm/s2, 10F8.2, dt 0.01",
        [MOTION],
    ),
}
"""The text of a file, the answer that a person gives for it, and the motions that it holds, m/s²."""


@pytest.mark.parametrize("name", MADE)
def test_a_layout_is_answered_once_and_read(tmp_path: Path, name: str) -> None:
    content, answer, motions = MADE[name]
    path = tmp_path / "made.txt"
    path.write_text(content)
    with pytest.raises(AskedError) as asked:
        read(path)
    question = asked.value.question
    assert "?" in question.proposal and "row" in question.holds
    answered(tmp_path, question, answer)
    for twin in (path, tmp_path / "twin.txt"):
        twin.write_text(content)
        records = read(twin)
        assert len(records) == len(motions)
        for record, motion in zip(records, motions, strict=True):
            assert record.time_step == pytest.approx(0.01, rel=1e-9)
            assert record.acceleration == pytest.approx(motion, abs=1.1e-5 if "F8" in answer else 2e-6)
            assert record.source.answer == f"read as {answer!r}, by layouts.csv"
    assert [record.vertical for record in records] == [motion is UP for motion in motions]


def test_a_last_row_that_is_cut_counts_in_no_peak_of_a_question(tmp_path: Path) -> None:
    (tmp_path / "made.txt").write_text(table(MOTION, OTHER, UP) + "99 99\n")
    with pytest.raises(AskedError) as asked:
        read(tmp_path / "made.txt")
    assert asked.value.question.holds == "column 1: ?; column 2: ?; column 3: ?; 600 rows"
    assert asked.value.question.signature.peaks == f"{np.abs([MOTION, OTHER, UP]).max():.3g}"


@pytest.mark.parametrize(("first", "factor", "above"), [
    ("600", 1, "n, "), ("598", 1, ""), ("600 0.01", 1, "n, dt, "), ("600 1", 1, "n, dt, "), ("600 1.5", 1, ""),
    ("600 20", 1, "n, hz, "), ("600 2000", 1, "n, hz, "), ("600 2001", 1, ""), ("600 19", 1, ""), ("600 20.5", 1, ""),
    ("0.01 600", 1, "dt, n, "), ("1.5 600", 1, ""), ("1 0.01", 0.4, "-, dt, "), ("1 0.01", 0.6, ""),
    ("1 0.0005", 0.4, "-, dt, "),
    ("1 0.05", 0.4, "-, dt, "), ("1 0.051", 0.4, ""), ("1 0.0004", 0.4, ""), ("2 0.01", 0.4, ""),
])  # fmt: skip
def test_numbers_above_a_series_are_proposed_as_what_they_can_be(
    tmp_path: Path, first: str, factor: float, above: str
) -> None:
    (tmp_path / "made.txt").write_text("\n".join(first.split()) + "\n" + table(factor * np.cos(7 * TIMES)))
    with pytest.raises(AskedError) as asked:
        read(tmp_path / "made.txt")
    assert asked.value.question.proposal.partition("one series")[0] == above


@pytest.mark.parametrize(("answer", "above"), [
    ("skip 1, n, dt, one series m/s2", "1 600 0.01"), ("skip 2, n, dt, hz, one series m/s2", "600 0.01 0.5 0.6"),
])  # fmt: skip
def test_numbers_above_a_series_that_are_others_than_the_answer_says_are_refused(
    tmp_path: Path, answer: str, above: str
) -> None:
    (tmp_path / "made.txt").write_text("El Centro\nfactor 1\n600 0.01\n0.5 0.6\n" + wrapped(MOTION, 8))
    with pytest.raises(AskedError) as asked:
        read(tmp_path / "made.txt")
    answered(tmp_path, asked.value.question, answer)
    with refused(RecordError, "above", above):
        read(tmp_path / "made.txt")


@pytest.mark.parametrize(("name", "content", "answer"), [
    ("SHAKE2000", SHAKE.format(name="x.acc") + wrapped(MOTION / G, 8, "9.6f", ""), "one series g, 8F9"),
    ("Strata", STRATA.format(name="a\\G01000.AT2") + table(TIMES, MOTION / G, parted=","), "t, a g"),
])  # fmt: skip
def test_a_layout_that_ships_is_not_asked(tmp_path: Path, name: str, content: str, answer: str) -> None:
    """As a public writer of SHAKE2000's files writes them, and as Strata's own example has them (strain, there)."""
    path = tmp_path / f"{name}.txt"
    path.write_text(content)
    (record,) = read(path)
    assert record.acceleration == pytest.approx(MOTION, abs=1e-5) and record.time_step == 0.01
    assert record.source.answer == f"read as {answer!r}, by the layouts of rocking"


def test_a_layout_that_ships_without_a_unit_asks_for_it_alone(tmp_path: Path) -> None:
    """DEEPSOIL's input motions: number and step above times and accelerations; other programs write other units so."""
    path = tmp_path / "made.txt"
    rows = table(TIMES, MOTION / G)
    path.write_text(f"600 0.01\n{rows}")
    with refused(AskedError, "unit") as asked:
        read(path)
    assert asked.value.question.proposal == "t, ?" and asked.value.question.signature.text_above == "n, dt"
    (record,) = read(path, unit="g")
    assert record.acceleration == pytest.approx(MOTION, abs=1e-5) and record.time_step == 0.01
    assert record.source.answer == "read as 't, a', by the layouts of rocking"
    answered(tmp_path, asked.value.question, "t, a g")
    assert read(path)[0].sha256 == record.sha256
    path.write_text(f"700 0.01\n{rows}")
    with refused(RecordError, "samples", 700):
        read(path)


def test_what_is_only_to_be_confirmed_is_not_answered_by_the_question(tmp_path: Path) -> None:
    path = tmp_path / "made.txt"
    path.write_text("Scale: 0.5\nt,acc (g)\n" + table(TIMES, MOTION / G, parted=","))
    with pytest.raises(AskedError) as asked:
        read(path)
    question = asked.value.question
    assert question.proposal == "? t, a g"
    answered(tmp_path, question, question.proposal)
    with pytest.raises(AskedError):
        read(path)
    (tmp_path / NAME).unlink()
    answered(tmp_path, question, "t, a g")
    (record,) = read(path)
    assert record.acceleration == pytest.approx(MOTION, abs=1e-5)


SPECTRUM = np.abs(MOTION) + 0.01
PERIODS = np.geomspace(0.01, 10, 600)
TOLD: list[tuple[str, str, object]] = [
    (
        "# Shear Strain Time Series\n# Time (s),S-1\n" + table(TIMES, MOTION, parted=","),
        "quantity",
        "shear strain",
    ),
    ("Time (s),Stress (kPa)\n" + table(TIMES, MOTION, parted=","), "columns", {"Stress (kPa)": "stress"}),
    ("Time,Force\n" + table(TIMES, MOTION, parted=","), "columns", {"Force": "force"}),
    ("Time,Moment (kNm)\n" + table(TIMES, MOTION, parted=","), "columns", {"Moment (kNm)": "moment"}),
    ("Time,Velocity\n" + table(TIMES, MOTION, parted=","), "quantity", "velocity"),
    ("time disp\n" + table(TIMES, MOTION), "quantity", "displacement"),
    ("T (s),PSA (g)\n" + table(PERIODS, SPECTRUM, parted=","), "quantity", "spectrum"),
    ("Period,Sa\n" + table(PERIODS, SPECTRUM, parted=","), "quantity", "spectrum"),
    ("f,FAS\n" + table(PERIODS, SPECTRUM, parted=","), "quantity", "spectrum"),
    (table(PERIODS, SPECTRUM, SPECTRUM), "layout", None),
    (table(PERIODS, SPECTRUM), "layout", None),
    ("t,CH1,CH2,CH3\n" + table(TIMES, MOTION, OTHER, UP, parted=","), "layout", None),
    ("t (s),CH1 (V)\n" + table(TIMES, MOTION, parted=","), "columns", {"CH1 (V)": "in v"}),
    (
        "t,normalized acc (g)\n" + table(TIMES, MOTION, parted=","),
        "columns",
        {"normalized acc (g)": "normalized"},
    ),
    ("t,acc (0.01 gal)\n" + table(TIMES, MOTION, parted=","), "layout", None),
    ("time,counts\n" + table(TIMES, 1e4 * MOTION, parted=","), "columns", {"counts": "counts"}),
    ("AGENCY\nCODE 12\nLAT 34.2\nFULL SCALE 2G\n" + wrapped(MOTION, 8), "layout", None),
    (table(MOTION, OTHER, UP), "layout", None),
]
"""The text of a file that holds no acceleration, or leaves open where, and the field and value refused."""


@pytest.mark.parametrize(("content", "field", "value"), TOLD)
def test_nothing_of_this_is_read_whatever_is_declared(
    tmp_path: Path, content: str, field: str, value: object
) -> None:
    (tmp_path / "made.txt").write_text(content)
    for declared in ({}, {"unit": "m/s2"}, {"unit": "m/s2", "time_step": 0.01}):
        with refused(RecordError, field, value):
            read(tmp_path / "made.txt", **declared)


@pytest.mark.parametrize("head", ["t L T V", "time,H1,H2,V", "t  FN FP UP"])
def test_names_of_axes_are_directions(tmp_path: Path, head: str) -> None:
    parted = "," if "," in head else " "
    (tmp_path / "made.txt").write_text(head + "\n" + table(TIMES, MOTION, OTHER, UP, parted=parted))
    with pytest.raises(AskedError) as asked:
        read(tmp_path / "made.txt")
    assert asked.value.question.proposal == "t, a ?, a ?, a ?"
    records = read(tmp_path / "made.txt", unit="m/s2")
    assert [record.component for record in records] == re.split(r"[, ]+", head)[1:]
    assert [record.vertical for record in records] == [False, False, True]
    assert records[1].acceleration == pytest.approx(OTHER, abs=2e-6)


def office(folder: Path, files: int) -> None:
    """A folder of an office: two families of files, each in a folder, and one file that needs nothing."""
    for family in ("one", "two"):
        (folder / family).mkdir()
    for place in range(files):
        moved = np.roll(MOTION, 7 * place)
        (folder / "one" / f"S{place:03}_N.txt").write_text(table(moved / G))
        (folder / "two" / f"{place:03}town.csv").write_text(
            f"Station {place} of the town\nTime,Q1\n" + table(TIMES, 100 * moved, parted=",")
        )
    (folder / "plain.csv").write_text("t,acc (m/s2)\n" + table(TIMES, MOTION, parted=","))


def test_many_files_of_two_layouts_cost_two_answers(tmp_path: Path) -> None:
    office(tmp_path, 8)
    target = tmp_path / "catalogue.csv"
    told = write_catalogue(tmp_path, target, None, None)
    assert told.count("Answer once, in layouts.csv") == 1 and "layouts.csv, and run this again" in told
    rows = list(csv.DictReader((tmp_path / NAME).read_text(encoding="utf-8").splitlines()))
    assert [(row["file"], row["folder"]) for row in rows] == [
        ("one/S000_N.txt", "one"),
        ("two/000town.csv", ""),
    ]
    assert rows[0]["holds"] == "one series in ?, 1 a line; 600 rows; 8 files with peaks 0.114"
    assert (
        rows[1]["holds"]
        == "column 1 (Time): times of 0.01 s; column 2 (Q1): ?; 600 rows; 8 files with peaks 112"
    )
    assert [row["answer"] for row in rows] == ["one series ?, dt ?", "t, ?"]
    answers = {"one/S000_N.txt": "one series g, dt 0.01", "two/000town.csv": "t, a gal"}
    assert answer_all(tmp_path, answers) == 2
    told = write_catalogue(tmp_path, target, None, None)
    assert "Answer once" not in told and "17 records" in told
    records = load_catalogue(target)
    notes = {record.file: record.note for record in records}
    assert notes["one/S003_N.txt"] == "columns of numbers. Read as 'one series g, dt 0.01', by layouts.csv."
    assert notes["two/003town.csv"] == "columns of numbers, read as 't, a gal', by layouts.csv."
    assert "Fill in" not in "".join(notes.values())
    for record in records:
        place = int("".join(filter(str.isdigit, record.file)) or 0)
        (channel,) = open_station(record).horizontal
        assert channel.acceleration == pytest.approx(np.roll(MOTION, 7 * place), abs=1e-5)
    before = (tmp_path / NAME).read_bytes()
    write_catalogue(tmp_path, target, None, None)
    assert (tmp_path / NAME).read_bytes() == before


def test_an_answer_is_part_of_the_content_of_the_records_that_it_reads_alone(tmp_path: Path) -> None:
    office(tmp_path, 2)
    target = tmp_path / "catalogue.csv"
    write_catalogue(tmp_path, target, None, None)
    answers = {"one/S000_N.txt": "one series g, dt 0.01", "two/000town.csv": "t, a gal"}
    answer_all(tmp_path, answers)
    write_catalogue(tmp_path, target, None, None)
    before = {record.id: answers_of(record) for record in load_catalogue(target)}
    assert sorted(map(len, before.values())) == [0, 1, 1, 1, 1]
    (tmp_path / NAME).write_text((tmp_path / NAME).read_text().replace("a gal", "a mg"))
    after = {record.id: answers_of(record) for record in load_catalogue(target)}
    assert {name for name in before if before[name] != after[name]} == {"000town", "001town"}
    # The readings that are kept know it as well.
    peaks = {file.file: file.channels[0].peak_acceleration for file in list_folder(tmp_path)[0]}
    kept = write_catalogue(tmp_path, target, None, None)
    assert peaks["two/001town.csv"] in kept


def test_a_signature_is_not_asked_again_and_another_folder_of_bare_columns_is(tmp_path: Path) -> None:
    office(tmp_path, 1)
    target = tmp_path / "catalogue.csv"
    write_catalogue(tmp_path, target, None, None)
    answer_all(tmp_path, {"one/S000_N.txt": "one series g, dt 0.01", "two/000town.csv": "t, a gal"})
    (tmp_path / "three").mkdir()
    (tmp_path / "three" / "x.txt").write_text(table(MOTION))
    (tmp_path / "three" / "y.csv").write_text("Station 9\nTime,Q1\n" + table(TIMES, 99 * MOTION, parted=","))
    write_catalogue(tmp_path, target, None, None)
    rows = list(csv.DictReader((tmp_path / NAME).read_text(encoding="utf-8").splitlines()))
    assert [row["file"] for row in rows if "?" in row["answer"]] == ["three/x.txt"]


@pytest.mark.parametrize(("answer", "words"), [
    ("t, a cm/s", "'cm/s' is no unit of acceleration"), ("t, -", "no column of 't, -' is of acceleration"),
    ("t, NS, EW g", "3 numbers a line, but this file has 2"), ("t fortnights, a g", "'fortnights', but must be in s"),
    ("one series g, a", "'a' is no part of an answer of one series"), ("t, 7% g", "'7%' names no component"),
    ("one series g, dt 0.02, skip 4, n", "'n' is no part of an answer"),
])  # fmt: skip
def test_a_wrong_line_names_the_column_and_the_file_it_was_drawn_from(
    tmp_path: Path, answer: str, words: str
) -> None:
    (tmp_path / "made.txt").write_text(table(TIMES, MOTION))
    (tmp_path / "good.csv").write_text("t,acc (m/s2)\n" + table(TIMES, MOTION, parted=","))
    with pytest.raises(AskedError) as asked:
        read(tmp_path / "made.txt")
    answered(tmp_path, asked.value.question, answer)
    with refused(RecordError, "answer"):
        read(tmp_path / "made.txt")
    listed, rows = list_folder(tmp_path)
    assert [row["file"] for row in rows] == ["good.csv"]
    assert [bool(file.refusal) for file in listed] == [False, True]


def test_a_file_that_looks_unlike_the_others_of_its_folder_is_told(tmp_path: Path) -> None:
    (tmp_path / "made.txt").write_text(wrapped(MOTION, 3))
    with pytest.raises(AskedError) as asked:
        read(tmp_path / "made.txt")
    answered(tmp_path, asked.value.question, "one series m/s2, 3 a line, dt 0.01")
    assert read(tmp_path / "made.txt")[0].warnings == ()
    (tmp_path / "other.txt").write_text(table(MOTION, OTHER, UP))
    (record,) = read(tmp_path / "other.txt")
    assert RecordKind.UNLIKE_ITS_ANSWER in {warning.kind for warning in record.warnings}


def test_an_answer_that_the_file_contradicts_is_refused(tmp_path: Path) -> None:
    (tmp_path / "made.txt").write_text("time,NS (g),Q\n" + table(TIMES, MOTION, OTHER, parted=","))
    with pytest.raises(AskedError) as asked:
        read(tmp_path / "made.txt")
    answered(tmp_path, asked.value.question, "t, NS gal, EW gal")
    with refused(RecordError, "answer", "t, NS gal, EW gal"):
        read(tmp_path / "made.txt")


def test_a_broken_table_of_layouts_is_told_in_a_sentence(tmp_path: Path) -> None:
    (tmp_path / "made.txt").write_text(table(TIMES, MOTION))
    (tmp_path / NAME).write_text("answer,strange\nt\n")
    for attempt in (read, lambda path: list_folder(path.parent)):
        with refused(CatalogueError, "columns"):
            attempt(tmp_path / "made.txt")


@pytest.mark.parametrize("answer", [
    "t, a g", "NS g, EW g, UD g", "one series g, 5 a line", "skip 2, n, dt, one series gal", "t ms, -, a mg",
    "one series ?, 10F8, dt 0.01", "hz, one series g", "t min, a g", "t h, a g", "t us, a g", "t, a g, 4 a line",
])  # fmt: skip
def test_an_answer_is_written_as_it_is_read(answer: str) -> None:
    layout = TableLayout.parse(answer.replace("?", "g"))
    assert TableLayout.parse(str(layout)) == layout
    assert str(layout) == answer.replace("?", "g")


@pytest.mark.parametrize(("answer", "written"), [
    ("time, NS, EW gal", "t, NS gal, EW gal"), ("T s, a g", "t, a g"), ("Skip 3, ONE SERIES g", "skip 3, one series g"),
    ("one series g, 5 per line, dt 0.01s", "one series g, 5 a line, dt 0.01"), ("a g, dt 0.005 s", "a g, dt 0.005"),
    ("times, acc g", "t, a g"), ("one series g, 8f9.6", "one series g, 8F9"), ("t,, m/s2,", "t, a m/s2"),
])  # fmt: skip
def test_other_spellings_of_an_answer_are_known(answer: str, written: str) -> None:
    assert str(TableLayout.parse(answer)) == written
