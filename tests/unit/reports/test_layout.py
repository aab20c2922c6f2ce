"""How a report falls onto pages: no table torn after a row or three, no page nearly empty."""

import re
import shutil
import subprocess
from dataclasses import replace

import pytest

from rocking.reports.document import compile_document
from rocking.reports.record.report import record_report

from .conftest import SETTINGS

TEMPLATE = """
#import "layout.typ": data, document-page, ruled
#show: document-page.with(title: "one", running: "one")
#v(float(data.above) * 1mm)
#figure(ruled(data.table), caption: [A table.])
"""
FOOTER = 780.0
"""Of 842 points: below stands the number of the page."""
COUNTS = (1, 3, 10, 40)


def pages(document: bytes) -> list[list[tuple[float, str]]]:
    """The words of each page, with the points of their lower edges from the upper edge of the page."""
    if shutil.which("pdftotext") is None:
        pytest.skip("pdftotext (poppler-utils) is not installed; it says for this test where the words stand")
    run = subprocess.run(["pdftotext", "-bbox", "-", "-"], input=document, capture_output=True, check=True)
    word = re.compile(r'yMax="([\d.]+)">(.*?)</word>')
    return [
        [(float(low), text) for low, text in word.findall(page)]
        for page in run.stdout.decode().split("<page ")[1:]
    ]


@pytest.mark.parametrize("count", [1, 8, 9, 12, 40])
def test_no_table_goes_on_over_a_page_after_one_row(count, tmp_path):
    """Wherever it begins on a page: at least four rows stand together, or the whole table."""
    (tmp_path / "one.typ").write_text(TEMPLATE)
    rows = [[f"row{place}", "1.0"] for place in range(count)]
    table = {"heads": ["Name", "Value"], "widths": ["1", "1"], "alignments": ["l", "r"], "rows": rows}
    torn = 0
    for above in range(150, 245, 8):
        document = compile_document(tmp_path / "one.typ", {"table": table, "above": str(above)})
        found = [sum(text.startswith("row") for _, text in page) for page in pages(document)]
        found = [many for many in found if many]
        assert sum(found) == count
        assert min(found) >= min(count, 4), above
        torn += len(found) > 1
    assert torn or count <= 8


@pytest.mark.parametrize("count", COUNTS)
def test_no_page_is_three_quarters_empty(example, count):
    """With names of 60 characters too: the last words of each page stand in its lower three quarters."""
    names = [
        f"structure {place} of the north transept, its upper gallery, west"[:60]
        for place in range(1, count + 1)
    ]
    kept = {
        table: [
            replace(row, structure=name)
            for name in names
            for row in getattr(example.tables, table)
            if row.structure == "wall 3 m"
        ]
        for table in ("predictions", "responses", "comparison", "ensemble", "candidates", "processing")
    }
    structures = dict.fromkeys(names, example.structures["wall 3 m"])
    tables = replace(example.tables, **kept)
    document = record_report(example.record, example.accelerograms, structures, tables, SETTINGS)
    for page in pages(document):
        assert max(low for low, _ in page if low < FOOTER) > 842 / 4
