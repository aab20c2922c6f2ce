"""One order of what is worst and one population of what is counted, whoever prints it."""

import itertools
import json
import math
import re
from dataclasses import replace

import pytest
from matplotlib.figure import Figure

from rocking.assessment.conclusion import conclusions, worst_of_each
from rocking.assessment.decide import Decision, Verdict, severity, worst_first
from rocking.assessment.methods import Agreement
from rocking.assessment.reserve import Reserve
from rocking.assessment.rows import (
    ComparisonRow,
    PulseRow,
    RecordRow,
    RecordRows,
    agreement_rows,
    counted_cases,
    worst_period_each,
)
from rocking.reports.explore import _NONE, explore_page
from rocking.reports.matrix import matrix
from rocking.reports.printing import chip
from rocking.reports.summary import severity_map, structure_table, summary_data
from rocking.structures import Block
from rocking.study.terminal import closing_lines
from tests.unit.assessment.made_rows import compared, decided, failure, filled
from tests.unit.reports.conftest import SETTINGS, summarised

FALLS, MAY_FALL, STANDS = Verdict.OVERTURNS, Verdict.PROBABLY_OVERTURNS, Verdict.STANDS
# By record and structure the word, the share and the least factor at which members overturn. "a" and "b" differ by the
# reserve alone; under "d" most is expected to fall, and nothing for sure.
MADE = {
    "a": {"wall": (FALLS, 1.0, 0.9), "pier": (STANDS, 0.0, 3.0), "arch": (STANDS, 0.0, 2.0)},
    "b": {"wall": (FALLS, 1.0, 0.4), "pier": (STANDS, 0.0, 2.5), "arch": (STANDS, 0.0, math.nan)},
    "c": {"wall": (STANDS, 0.0, 1.5), "pier": (STANDS, 0.04, 1.2), "arch": (STANDS, 0.0, 1.3)},
    "d": {"wall": (MAY_FALL, 0.9, 0.5), "pier": (MAY_FALL, 0.9, 0.7), "arch": (MAY_FALL, 0.9, 0.6)},
}
RECORDS, STRUCTURES = ["b", "a", "d", "c"], ["wall", "arch", "pier"]


def made_rows():
    """The rows of MADE; a further record failed and has none."""
    return [
        decided(
            Decision(word, share, (share, share), ""),
            Reserve(low=low, median=math.nan, high=math.nan, limit=3.0),
            record=record,
            structure=structure,
            rotation_ratio=0.5,
        )
        for record, cases in MADE.items()
        for structure, (word, share, low) in cases.items()
    ]


def test_the_key_is_the_word_then_the_share_then_the_smallest_reserve_then_the_rotation():
    """Held against every pair of sixteen cases, compared by words."""
    of_each = list(itertools.product((STANDS, FALLS), (0.0, 0.5), (2.0, math.nan), (0.1, 0.2)))
    keys = [
        severity(Decision(word, share, (share, share), ""), factor=factor, rotation_ratio=rotation_ratio)
        for word, share, factor, rotation_ratio in of_each
    ]
    for (first, a), (second, b) in itertools.combinations(zip(of_each, keys, strict=True), 2):
        place = next(k for k in range(4) if repr(first[k]) != repr(second[k]))
        worse = {
            0: first[0] is FALLS,
            1: first[1] > second[1],
            2: not math.isnan(first[2]),
            3: first[3] > second[3],
        }[place]
        assert (a > b) is worse


def test_a_share_that_is_only_known_at_least_counts_so():
    known = severity(Decision(Verdict.CANNOT_BE_TOLD, math.nan, (0.3, 1.0), ""))
    assert known[1] == 0.3
    assert severity(Decision(Verdict.CANNOT_BE_TOLD, math.nan, (math.nan, math.nan), ""))[1] == -1


def test_of_equal_worst_cases_the_one_under_which_more_falls_comes_first():
    def key(share):
        return severity(Decision(MAY_FALL, share, (share, share), ""))

    cases = [
        ("one", key(0.9)),
        ("two", key(0.9)),
        ("two", key(0.7)),
        ("three", key(0.8)),
        ("three", key(0.8)),
    ]
    assert worst_first(cases) == ["two", "one", "three"]
    assert worst_first([("x", key(0.7)), ("y", key(0.7))]) == ["x", "y"]


UNKNOWN, NEARLY = Verdict.CANNOT_BE_TOLD, Verdict.PROBABLY_STANDS
CELLS = {
    "wall": (FALLS, 1.0, (1.0, 1.0)), "top": (UNKNOWN, math.nan, (0.3, 1.0)),
    "arch": (UNKNOWN, math.nan, (math.nan, math.nan)), "rest": (NEARLY, 0.03, (0.03, 0.03)),
    "pier": (STANDS, 0.0, (0.0, 0.0)), "base": (Verdict.CANNOT_OVERTURN, 0.0, (0.0, 0.0)),
}  # fmt: skip


@pytest.mark.parametrize(("records", "shares", "has_room"), [
    (2, ["100\u00a0%", "", "", "3\u00a0%", "0\u00a0%", ""], True),
    (3, ["100", "≥30", "?", "3", "0", "–"], True), (5, ["100", "≥30", "?", "3", "0", "–"], True),
    (6, ["100", "≥30", "", "", "", ""], False), (12, ["100", "≥30", "", "", "", ""], False), (13, [], False),
])  # fmt: skip
def test_the_cells_of_the_matrix_hold_what_they_have_room_for(records, shares, has_room):
    """Words in cells of two records, of up to five what every cell can say, of up to twelve what may fall."""
    motions = [
        filled(RecordRow, record=f"r{k}", peak_acceleration_m_s2=9.80665 / (k + 1)) for k in range(records)
    ]
    made = [
        decided(Decision(word, share, interval, ""), record=row.record, structure=name, rotation_ratio=0.5)
        for row in motions
        for name, (word, share, interval) in CELLS.items()
    ]
    pulse = filled(PulseRow, record="r1", explained_energy=0.42, kind="alternative", rank=1)
    beside = matrix(conclusions(made, []), motions, [pulse])
    in_words = records == 2
    of_each = [chip(CELLS[name][0], share) for name, share in zip(CELLS, shares, strict=False)]
    if not in_words:
        of_each = [replace(cell, verdict="") for cell in of_each]
    assert [row.name for row in beside.rows] == list(CELLS)[: len(shares)]
    assert [row.cells for row in beside.rows] == [(cell,) * records for cell in of_each]
    assert beside.upright is (bool(shares) and not has_room)
    assert [cell.verdict for cell in beside.legend] == [
        "overturns", "? cannot be told", "probably stands", "stands", "cannot overturn"
    ] * (bool(shares) and not in_words)  # fmt: skip
    heads = ["1.0 g", "0.50 g" + "; sine 42\u00a0%" * in_words, "0.33 g", "0.25 g", "0.20 g"][:records]
    assert [head.below for head in beside.heads] == (heads if has_room else [""] * records * bool(shares))


@pytest.mark.usefixtures("undrawn")
def test_every_document_has_one_order_of_records_and_structures_and_counts_the_same():
    rows = made_rows()
    made = conclusions(rows, [])
    worst = {item.row.structure: item.row.record for item in worst_of_each(made)}
    assert list(worst.items()) == [("wall", "b"), ("arch", "d"), ("pier", "d")]

    beside = matrix(made, [], [])
    assert [head.name for head in beside.heads] == RECORDS
    assert [one_row.name for one_row in beside.rows] == STRUCTURES
    mapped = severity_map(worst_period_each(rows), [])
    assert [other_row.record for other_row in mapped.rows] == RECORDS
    assert list(mapped.heads) == STRUCTURES
    (line,) = severity_map([replace(rows[0], support_period_s=0.25)], []).rows
    assert line.cells[0].text.endswith(" at\u00a00.25\u00a0s")
    table = structure_table(rows)
    assert [line[0].text for line in table.rows] == STRUCTURES
    at = table.heads.index("Worst record")
    assert [line[at] for line in table.rows] == ["b", "d", "d"]

    lines = list(closing_lines(rows, [], [failure("", "", "not read.", "e")]))
    assert lines[0].startswith("4 records, 3 structures.")
    first = next(line for line in lines if line.startswith("wall"))
    assert first.split()[1] == "b" and "0.40–3+" in first, "the reserve by which it comes first"

    nothing = {"verdict": Verdict.CANNOT_BE_TOLD, "severity": _NONE}
    contents = [{"id": "e", "cases": dict.fromkeys(STRUCTURES, nothing)}]
    contents += [
        {"id": record, "cases": {row.structure: cell(row) for row in rows if row.record == record}}
        for record in MADE
    ]
    page = explore_page(contents, dict.fromkeys(("pier", "arch", "wall"), Block(2.0, 0.2))).decode()
    content = json.loads(re.search(r'<script type="application/json" id="content">(.*?)</script>', page)[1])
    for case, names in (("records", [*RECORDS, "e"]), ("structures", STRUCTURES)):
        ranks = {one.get("id") or one["name"]: one["rank"] for one in content[case]}
        assert sorted(ranks, key=ranks.__getitem__) == names
    assert "4 records, 3 structures" in page, "one that failed is no record that was judged"

    tables = summarised(RecordRows(verdicts=rows, record=[filled(RecordRow, record="e", component="EW")]), {})
    assert summary_data(tables, SETTINGS).subtitle.startswith("4 records")


def cell(row):
    """What the page to explore is told of a case, as far as it orders by it."""
    return {"verdict": row.verdict, "severity": [max(number, -1e9) for number in row.severity]}


def carried_rows():
    """A parapet at ten periods and on the ground, which falls at each; a pier and an arch on the ground."""
    periods = [0.0, *(0.1 * (1 + place) for place in range(10))]
    shares = [1.0 if abs(period - 0.4) < 0.01 else 0.9 for period in periods]
    verdicts = [
        decided(Decision(FALLS, share, (share, share), ""), structure="parapet", support_period_s=period)
        for period, share in zip(periods, shares, strict=True)
    ]
    verdicts += [decided(Decision(FALLS, 1.0, (1.0, 1.0), ""), structure=name) for name in ("pier", "arch")]
    # Its closed form sees the fall on the ground and at every period but that of its verdict.
    comparison = [
        compared(
            component,
            math.inf,
            "parapet",
            support_period_s=period,
            predicted_rotation_ratio=0.5 if share == 1.0 else math.inf,
            agreement=Agreement.TOO_LOW if share == 1.0 else Agreement.SAME,
            verdict=FALLS,
        )
        for period, share in zip(periods, shares, strict=True)
        for component in ("EW", "NS")
    ]
    comparison.append(compared("EW", math.inf, "pier", predicted_rotation_ratio=math.inf, verdict=FALLS))
    comparison.append(compared("EW", 0.4, "arch", predicted_rotation_ratio=math.inf, verdict=FALLS))
    return verdicts, comparison


@pytest.mark.usefixtures("undrawn")
def test_every_count_is_of_each_structure_once_at_the_period_of_its_verdict():
    """Under two components the parapet falls twice, unseen, and not 22 times of which 20 are seen."""
    verdicts, comparison = carried_rows()
    cases = list(counted_cases(comparison, verdicts))
    assert [(row.structure, row.component, row.support_period_s) for row in cases] == [
        ("parapet", "EW", pytest.approx(0.4)),
        ("parapet", "NS", pytest.approx(0.4)),
        ("pier", "EW", None),
        ("arch", "EW", None),
    ]
    of_all, *of_each = agreement_rows(cases, {})
    assert (of_all.cases, of_all.overturning, of_all.overturning_hits) == (4, 3, 1)
    assert [(row.structure, row.cases) for row in of_each] == [("parapet", 2), ("pier", 1), ("arch", 1)]

    page = summary_data(summarised(RecordRows(comparison=comparison, verdicts=verdicts), {}), SETTINGS)
    (method, *counts) = page.methods.table.rows[0]
    assert counts[0] == "4", method
    assert page.agreement.table.rows[0][3] == "4"
    assert len(page.unsafe.table.rows) == 2


@pytest.mark.usefixtures("undrawn")
def test_the_scatter_counts_the_cases_of_the_table_and_says_which(monkeypatch):
    verdicts, comparison = carried_rows()
    monkeypatch.setattr("rocking.reports.summary.FEWEST_POINTS", 1)
    drawn = []
    monkeypatch.setattr(
        "rocking.reports.summary.prediction_scatter", lambda rows, *others: drawn.extend(rows) or Figure()
    )
    page = summary_data(summarised(RecordRows(comparison=comparison, verdicts=verdicts), {}), SETTINGS)
    (scatter,) = page.scatter
    assert len(drawn) == 4 and all(isinstance(row, ComparisonRow) for row in drawn)
    assert scatter.heading == "The closed form sees 1 of 3 falls"
    assert "at the period of its verdict" in scatter.counted
    alone = [row for row in comparison if row.support_period_s is None]
    page = summary_data(summarised(RecordRows(comparison=alone, verdicts=verdicts), {}), SETTINGS)
    assert page.scatter[0].counted == ""


def test_records_under_which_nothing_lifts_share_a_line():
    rows = [replace(row, rotation_ratio=0.5) for row in made_rows()]
    still = [replace(row, record="still", rotation_ratio=0.0) for row in rows if row.record == rows[0].record]
    shown = matrix(conclusions([*rows, *still], []), [], [])
    assert sorted(head.name for head in shown.heads) == sorted({row.record for row in rows})
    assert "Nothing lifts under still." in shown.note
    assert [head.name for head in matrix(conclusions(still, []), [], []).heads] == ["still"], "the only ones"
