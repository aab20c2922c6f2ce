"""What a person is told of a run and of records: each case in its group, worst component and ensemble included."""

import math

from rocking.assessment.case import PeriodResult
from rocking.assessment.rows import ComparisonRow, agreement_rows
from rocking.study.terminal import closing_lines, record_line
from tests.unit.assessment.made_rows import broken, case, compared, failure, station, verdicts


def test_the_worst_component_counts() -> None:
    stations = [
        station(case("EW", 0.5), case("NS", math.inf)),
        station(case("EW", 0.25, "wall"), case("NS", 0.0005, "wall")),
        station(case("EW", 0.0, "arch")),
    ]
    line = record_line(verdicts(stations), [])
    assert line == "uncertain: pier (one run); probably stands: wall (one run); stands: arch"
    named = station(case("", 0.25, "nave, bay 7", falls=0)), station(case("", 0.2, "wall", falls=0))
    assert record_line(verdicts(named), []) == 'stands: "nave, bay 7" 0.25, wall 0.2'


def test_what_is_not_sure_is_ordered_by_share() -> None:
    stations = [
        station(case("EW", 0.25, "pier", falls=5)),
        station(case("EW", 0.25, "wall", falls=60)),
        station(case("EW", 0.25, "arch", falls=0)),
    ]
    line = record_line(verdicts(stations), [])
    assert line == "probably overturns: wall (94\u00a0%); probably stands: pier (8\u00a0%); stands: arch 0.25"


def test_a_line_names_eight_structures_at_most_and_counts_the_others() -> None:
    many = [station(case("EW", 0.25, f"pier {number}", falls=5)) for number in range(20)]
    line = record_line(verdicts([*many, station(case("EW", 0.25, "wall", falls=64))]), [])
    assert line.startswith("overturns: wall (100\u00a0%); probably stands: pier 0")
    assert line.count("pier") == 7 and line.endswith("; 13 structures more in verdicts.csv")
    line = record_line(verdicts(many[:8]), [])
    assert line.count("pier") == 8 and "more" not in line


def test_a_failure_stands_first_without_repeating_the_record() -> None:
    failures = [failure("", "wall", "it cannot stand."), failure("", "", "it cannot be read.")]
    line = record_line(verdicts([station(case("", 0.5))]), failures)
    assert line == "failed: wall: it cannot stand. it cannot be read.; uncertain: pier (one run)"


def compared_as(station_: PeriodResult, record: str, predicted: float) -> list[ComparisonRow]:
    """Rows of the comparison of a station, the closed form and what was integrated."""
    return [
        compared(
            name,
            case.integrated_rotation_ratio,
            station_.structure,
            record=record,
            predicted_rotation_ratio=predicted,
        )
        for name, case in station_.cases.items()
    ]


def test_the_end_says_the_conclusion_the_worst_five_by_every_method_and_what_the_closed_form_saw() -> None:
    first = [station(case("EW", math.inf, falls=60)), station(case("EW", math.inf, "wall", falls=64))]
    second = [
        station(case("EW", math.inf, falls=64)),
        station(case("EW", 0.1, "wall", falls=0)),
        *(station(case("EW", 0.1, f"arch {number}", falls=0)) for number in range(12)),
    ]
    rows = [*verdicts(first, "a"), *verdicts(second, "b")]
    comparison = [
        *compared_as(first[0], "a", math.inf),
        *compared_as(first[1], "a", 0.44),
        *compared_as(second[0], "b", 0.2),
        *compared_as(second[1], "b", math.inf),
    ]
    agreed = [*agreement_rows(comparison, {})]
    lines = list(closing_lines(rows, comparison, [failure("", "", "not read.", "c")], agreed=agreed))
    assert (
        lines[0] == "2 records, 14 structures. 2 of 14 structures overturn or probably do under some record."
    )
    table = {line[:16].strip(): line[16:].split() for line in lines[4:9]}
    assert table["wall"] == ["a", "0.44", "–", "falls", "–", "overturns", "100", "%"]
    assert table["pier"] == ["b", "0.20", "–", "falls", "–", "overturns", "100", "%"]
    assert len(table) == 5
    assert lines[9].startswith("Others  stands: arch ") and lines[9].endswith(
        "; 6 structures more in verdicts.csv"
    )
    assert sum(line.count("arch") for line in lines[4:10]) == 3 + 3, "eight names with the pier and the wall"
    assert lines[-2:] == [
        "The closed form sees 1 of 3 falls; 1 false alarm.",
        "1 record failed, wholly or in part: c; the first: not read.",
    ]
    assert max(map(len, lines)) <= 104


def test_lines_at_the_end_are_no_wider_than_104_letters_whatever_the_names() -> None:
    names = [f"the structure {number} of the north transept, its upper gallery, west" for number in range(30)]
    stations = [station(case("EW", math.inf, name, falls=60)) for name in names]
    names_of_records = [f"record {number} whose name no column has room for, by far" for number in range(12)]
    rows = [row for record in names_of_records for row in verdicts(stations, record)]
    comparison = [
        row
        for record in names_of_records
        for one_station in stations
        for row in compared_as(one_station, record, 0.1)
    ]
    failures = [failure("", "", "not read.", record) for record in names_of_records]
    lines = list(closing_lines(rows, comparison, failures))
    assert max(map(len, lines)) <= 104 and len(lines) < 24


def test_a_fault_of_a_structure_under_all_records_is_a_sentence_and_no_record() -> None:
    faults = [failure("", "pier", f"a fault {number}.", "") for number in range(20)]
    lines = list(closing_lines([], [], [*faults, failure("", "wall", "a fault.", "c")]))
    assert lines == [
        *(f"pier: a fault {number}." for number in range(8)),
        "1 record failed, wholly or in part: c; the first: a fault.",
    ]


def test_nothing_overturns() -> None:
    stands = verdicts([station(case("", 0.1, falls=0))])
    assert next(closing_lines(stands, [], [])) == "1 record, 1 structure. pier stands."
    unknown = verdicts([station(broken(""))])
    assert list(closing_lines(unknown, [], []))[4].split()[:2] == ["pier", "a"]
    assert list(closing_lines([], [], [])) == []
