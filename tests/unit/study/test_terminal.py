"""What a person is told of a run and of records: each case in its group, worst component and ensemble included."""

import math
from dataclasses import replace
from pathlib import Path

from rocking.assessment.case import PeriodResult, SceneResult
from rocking.assessment.rows import ComparisonRow
from rocking.floors.place import place_from_config
from rocking.study.terminal import _cut, closing_lines, paths_to_read, record_line
from tests.unit.assessment.made_rows import broken, case, compared, failure, station, verdicts


def alone(*stations: PeriodResult) -> list[SceneResult]:
    """Results of scenes on the ground."""
    return [SceneResult(station.scene, (station,)) for station in stations]


def carried(count: int) -> list[SceneResult]:
    """Results of as many scenes on a floor, on the ground below and on it."""
    support = {"name": "floor", "period_s": 0.3, "damping_ratio": 0.05, "participation": 1.3}
    place = place_from_config(support)
    results = []
    for number in range(count):
        ground = station(case("EW", 0.25, f"statue {number}", falls=0))
        scene = replace(ground.scene, place=place)
        on_floor = replace(ground, scene=scene, support=place.supports[0])
        results.append(SceneResult(scene, (replace(ground, scene=scene), on_floor)))
    return results


def test_the_worst_component_counts() -> None:
    stations = [
        station(case("EW", 0.5), case("NS", math.inf)),
        station(case("EW", 0.25, "wall"), case("NS", 0.0005, "wall")),
        station(case("EW", 0.0, "arch")),
    ]
    line = record_line(alone(*stations), [])
    assert line == "uncertain: pier (one run); probably stands: wall (one run); stands: arch"
    named = station(case("", 0.25, "nave, bay 7", falls=0)), station(case("", 0.2, "wall", falls=0))
    divided = record_line(alone(*named), [])
    assert divided == 'stands: "nave, bay 7" 0.25, wall 0.2'


def test_what_is_not_sure_is_ordered_by_share_and_counted_where_there_is_much_of_it() -> None:
    stations = [
        station(case("EW", 0.25, "pier", falls=5)),
        station(case("EW", 0.25, "wall", falls=60)),
        station(case("EW", 0.25, "arch", falls=0)),
    ]
    line = record_line(alone(*stations), [])
    assert line == "probably overturns: wall (94\u00a0%); probably stands: pier (8\u00a0%); stands: arch 0.25"


def test_a_line_names_eight_structures_at_most_and_counts_the_others() -> None:
    many = [station(case("EW", 0.25, f"pier {number}", falls=5)) for number in range(20)]
    stands = [station(case("EW", 0.25, "arch", falls=0)), station(case("EW", 0.25, "wall", falls=64))]
    line = record_line(alone(*many, *stands), [])
    assert line.count("pier") == 7 and "pier 6 (8\u00a0%), 13 more; stands: 1" in line
    assert line.startswith("overturns: wall (100\u00a0%); probably stands: pier 0")


def test_eight_structures_are_all_named_and_no_more_is_counted_behind_them() -> None:
    many = [station(case("EW", 0.25, f"pier {number}", falls=5)) for number in range(8)]
    line = record_line(alone(*many), [])
    assert line.endswith("pier 7 (8\u00a0%)") and "more" not in line
    first, second = carried(2)
    line = record_line([*alone(*many[:7]), first], [])
    assert line.count("pier") == 7 and line.endswith(f"; {first.sentence}")
    line = record_line([*alone(*many[:7]), first, second], [])
    assert line.endswith(f"; {first.sentence}; 1 structure more on supports, in verdicts.csv")
    line = record_line([*alone(*many), first], [])
    assert line.endswith("; 1 structure on supports, in verdicts.csv")


def test_a_failure_stands_first_without_repeating_the_record() -> None:
    failures = [failure("", "wall", "it cannot stand."), failure("", "", "it cannot be read.")]
    line = record_line(alone(station(case("", 0.5))), failures)
    assert line == "failed: wall: it cannot stand. it cannot be read.; uncertain: pier (one run)"


def compared_as(station_: PeriodResult, record: str, predicted: float) -> list[ComparisonRow]:
    """Rows of the comparison of a station, the closed form beside what was integrated."""
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
    lines = list(closing_lines(rows, comparison, [failure("", "", "not read.", "c")]))
    assert (
        lines[0] == "2 records, 14 structures. 2 of 14 structures overturn or probably do under some record."
    )
    table = {line[:16].strip(): line[16:].split() for line in lines[4:9]}
    assert table["wall"] == ["a", "0.44", "–", "falls", "–", "overturns", "100", "%"]
    assert table["pier"] == ["b", "0.20", "–", "falls", "–", "overturns", "100", "%"]
    assert len(table) == 5
    assert lines[9].startswith("Others  stands: arch ") and lines[9].endswith(", 6 more")
    assert sum(line.count("arch") for line in lines[4:10]) == 3 + 3, "eight names with the pier and the wall"
    closed_form = (
        "Closed form against integration: 1 of 3 falls seen, 2 missed (1 of them in a), 1 false alarm"
    )
    assert lines[-2:] == [closed_form, "1 record failed, wholly or in part: c"]
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
        "1 record failed, wholly or in part: c",
    ]


def test_nothing_overturns() -> None:
    stands = verdicts([station(case("", 0.1, falls=0))])
    assert next(closing_lines(stands, [], [])) == "1 record, 1 structure. pier stands."
    unknown = verdicts([station(broken(""))])
    assert list(closing_lines(unknown, [], []))[4].split()[:2] == ["pier", "a"]
    assert list(closing_lines([], [], [])) == []


def test_the_paths_are_those_that_this_run_makes_whatever_lies_there(tmp_path: Path) -> None:
    summary = tmp_path / "summary"
    summary.mkdir()
    rows = verdicts([station(case("EW", 0.25, "pier", falls=5))])
    report = tmp_path / rows[0].record / "report.pdf"
    report.parent.mkdir()
    of_a_former_run = summary / "summary.pdf", summary / "study.html", summary / "structures.pdf", report
    for path in of_a_former_run:
        path.touch()

    def paths(reports: bool, checked: bool) -> list[str]:
        opened = {summary / "structures.pdf": "to sign"} if checked else {}
        lines = paths_to_read(tmp_path, rows, reports, opened)
        return [line[8:].split("  ")[0] for line in lines]

    assert paths(reports=False, checked=False) == [str(summary)]
    assert paths(reports=False, checked=True) == [str(summary), str(summary / "structures.pdf")]
    assert paths(reports=True, checked=False) == [
        str(path) for path in (summary / "summary.pdf", report, summary / "study.html")
    ]
    assert len(paths(reports=True, checked=True)) == 4
    first, *others = paths_to_read(
        tmp_path, rows, reports=True, opened={summary / "structures.pdf": "to sign"}
    )
    assert first.startswith("Open") and not any(line.startswith("Open") for line in others)


def test_a_name_that_is_cut_is_as_wide_as_its_column() -> None:
    assert _cut("a tower", 7) == "a tower"
    assert _cut("a towers", 7) == "a towe…" and len(_cut("a towers", 7)) == 7
