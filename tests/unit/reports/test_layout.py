"""How a report falls onto pages: no table torn after a row or three, no page nearly empty."""

import itertools
from dataclasses import dataclass, fields

import pytest

from rocking import DesignSpectrum, check
from rocking.assessment.rows import RecordRows
from rocking.products.checks.conclusion import code_conclusion_in_words, code_conclusions
from rocking.products.checks.rows import CodeCheckRow, code_check_rows
from rocking.reports.pages import Page, PageTable
from rocking.reports.printing import compile_document
from rocking.reports.summary import summary_data

from .conftest import SETTINGS, Word, of_structures, pages, summarised, summary_report

TEMPLATE = """
#import "layout.typ": data, document-page, ruled
#show: document-page.with(title: "one", running: "one")
#v(float(data.above) * 1mm)
#figure(ruled(data.table), caption: [A table.])
"""
FOOTER = 780.0
"""Of 842 points: below stands the number of the page."""
COUNTS = (1, 3, 10)
WALLS = ("wall", "pier", "arch", "tower", "nave")
WORDS = [f"{side}{noun}" for side in ("North", "South", "East", "West") for noun in WALLS]


@dataclass(frozen=True, kw_only=True)
class Above(Page):
    """A table below so much room, mm."""

    table: PageTable
    above: str


def covered(page: list[Word]) -> list[tuple[str, str]]:
    """Pairs of words of which one stands on half of the other or more; a subscript reaches into the line below it."""
    pairs = []
    for one, other in itertools.combinations(page, 2):
        width = min(one[2], other[2]) - max(one[0], other[0])
        height = min(one[3], other[3]) - max(one[1], other[1])
        smaller = min((case[2] - case[0]) * (case[3] - case[1]) for case in (one, other))
        if width > 0 and height > 0 and width * height > smaller / 2:
            pairs.append((one[4], other[4]))
    return pairs


def assert_well_laid(document: bytes) -> list[list[Word]]:
    """No page is three quarters empty, no word stands on another; returns the words of the pages."""
    words = pages(document)
    for page in words:
        assert max(word[3] for word in page if word[3] < FOOTER) > 842 / 4
        assert covered(page) == []
    return words


def sixty(noun: str, count: int) -> list[str]:
    """Names of 60 characters."""
    return [
        f"{noun} {place} of the north transept, its upper gallery, to the west"[:60]
        for place in range(1, count + 1)
    ]


@pytest.mark.process
@pytest.mark.parametrize("count", [1, 9, 40])
def test_no_table_goes_on_over_a_page_after_one_row(count, tmp_path, monkeypatch):
    """Wherever it begins on a page: at least four rows stand together, or the whole table."""
    (tmp_path / "one.typ").write_text(TEMPLATE)
    monkeypatch.setattr(Above, "template", tmp_path / "one.typ", raising=False)
    rows = tuple((f"row{place}", "1.0") for place in range(count))
    table = PageTable(("Name", "Value"), ("1", "1"), ("l", "r"), rows)
    torn = 0
    for above in range(150, 245, 8):
        document = compile_document(Above(title="one", table=table, above=str(above)))
        counts = [sum(word[4].startswith("row") for word in page) for page in pages(document)]
        counts = [many for many in counts if many]
        assert sum(counts) == count
        assert min(counts) >= min(count, 4), above
        torn += len(counts) > 1
    assert torn or count <= 8


@pytest.mark.process
@pytest.mark.parametrize("count", COUNTS)
def test_the_report_of_a_record_is_well_laid(example, count):
    """With names of 60 characters too."""
    names = sixty("structure", count)
    report = of_structures(example, dict.fromkeys(names, "wall 3 m"))
    assert len(assert_well_laid(report.pdf())) == (2 if count < 10 else 3)


@pytest.mark.process
@pytest.mark.parametrize("count", [1, 12, 20])
def test_page_one_holds_every_structure_with_its_whole_name(example, count):
    """Up to twenty, with names of 60 characters, whose words stand in lines below each other."""
    kinds = list(example.structures)
    names = {
        name: kinds[place % len(kinds)]
        for place, name in enumerate(
            f"{word}, the north transept's upper gallery, west" for word in WORDS[:count]
        )
    }
    page = assert_well_laid(of_structures(example, names).pdf())[0]
    text = "".join(word[4] for word in page)
    assert all(name.partition(",")[0] in text for name in names)
    assert sum(word[4].startswith("gallery") for word in page) >= count


@pytest.mark.process
@pytest.mark.parametrize(("count", "records"), list(zip(COUNTS, (1, 13, 13), strict=True)))
def test_the_summary_is_well_laid(example, count, records):
    """Structures that overturn, rock and rest in turn, under one record and under many."""
    names, kinds = sixty("structure", count), list(example.structures)
    kind = {name: kinds[place % len(kinds)] for place, name in enumerate(names)}
    rows = [of_structures(example, kind, record).tables for record in sixty("record", records)]
    tables = RecordRows(
        **{
            table.name: [row for one_row in rows for row in getattr(one_row, table.name)]
            for table in fields(RecordRows)
        }
    )
    structures = {name: example.structures[kind[name]] for name in names}
    document = assert_well_laid(summary_report(summarised(tables, structures), SETTINGS))
    rows = [sum(word[4] == "transept," for word in page) for page in document]
    assert sum(rows) >= 2 * count + records, "in the fates and the agreement; in the list of records"
    assert (len(document) > 1) == (count * records > 1), "one case takes one page"


@pytest.mark.process
@pytest.mark.parametrize(("records", "count"), [(2, 12), (4, 12), (10, 12), (10, 20)])
def test_the_first_page_of_the_summary_holds_matrix_and_scatter_in_at_most_260_words(example, records, count):
    """Of structures with names of two words, at a design level."""
    named = WORDS[:records]
    kinds = [*example.structures] * 4
    kind = {f"structure {place}": name for place, name in enumerate(kinds[:count])}
    rows = [of_structures(example, kind, record).tables for record in named]
    tables = RecordRows(
        **{
            table.name: [row for one_row in rows for row in getattr(one_row, table.name)]
            for table in fields(RecordRows)
        }
    )
    structures = {name: example.structures[item] for name, item in kind.items()}
    level = DesignSpectrum.ntc(ag=0.3, f0=2.5, tc_star=0.35)
    checks = [
        row
        for name, structure in structures.items()
        for row in code_check_rows(name, check(structure, level))
    ]
    shown = summarised(tables, structures) | {CodeCheckRow: checks}
    by_the_code = code_conclusion_in_words(code_conclusions(checks))
    page = pages(compile_document(summary_data(shown, SETTINGS, other_conclusions=[by_the_code])))[0]
    assert covered(page) == []
    first = [word[4] for word in page]
    assert len(first) <= 260
    text = " ".join(first)
    assert f"{len(named)} records, {count} structures" in text
    assert "By the code" in text
    known = ["to know"] if records < 10 else []
    seen = [text.index(words) for words in ("under some record", *known, "The closed form sees", "missed")]
    assert seen == sorted(seen), "the answer, the matrix, then the scatter with its counts"
