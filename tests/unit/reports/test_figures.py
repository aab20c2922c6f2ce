"""The figures of a report as files: every one of the report, as vectors and as pixels, the same bytes at every run."""

import io
import zipfile
from xml.etree import ElementTree

import pytest
from PIL import Image

from rocking.products.trade.report import write_trade_report
from rocking.products.trade.rows import TradeMethod, TradeRow
from rocking.reports.pages import PlainPage
from rocking.reports.printing import figures_archive, write_document
from tests.unit.assessment.made_rows import filled


@pytest.fixture(scope="module")
def data(example):
    return example.page()


def opened(content):
    return zipfile.ZipFile(io.BytesIO(content))


def test_every_figure_of_a_report_is_a_file_of_each_kind(data):
    archive = opened(figures_archive(data, "svg and png"))
    names = [name.rsplit(".", 1) for name in archive.namelist()]
    vectors = [name for name, kind in names if kind == "svg"]
    assert vectors == [name for name, kind in names if kind == "png"]
    drawn = str(data).count("Picture(")
    assert len(vectors) == drawn > len(data.page_one.rows)
    for name in vectors:
        svg = ElementTree.fromstring(archive.read(f"{name}.svg"))
        width, height = (
            float(svg.get(choice).removesuffix("pt").removesuffix("mm")) for choice in ("width", "height")
        )
        pixels = Image.open(io.BytesIO(archive.read(f"{name}.png"))).size
        assert pixels[0] / pixels[1] == pytest.approx(width / height, rel=0.25), "but for the margin of 4 pt"
    assert vectors[0].startswith("01_acceleration-of-the-ground")


@pytest.mark.parametrize(("kinds", "named"), [("none", []), ("svg", ["trade_figures.zip"])])
def test_the_figures_of_a_document_stand_beside_it(tmp_path, kinds, named):
    """Of any document: the one of the trade has the figure that its summary has too."""
    rows = [
        filled(
            TradeRow,
            structure="",
            method=method,
            cases=3,
            error=0.1,
            wrong_verdicts=1,
            unsafe_verdicts=0,
            stations=3,
            earthquakes=3,
            cpu_s=1e-4,
            preparation_record_s=1e-3,
        )
        for method in TradeMethod
    ]
    write_trade_report({TradeRow: rows}, tmp_path / "trade.pdf", tmp_path / "trade.svg", kinds)
    assert sorted(path.name for path in tmp_path.iterdir()) == sorted(["trade.pdf", "trade.svg", *named])
    assert write_document(tmp_path / "a.pdf", PlainPage(title="a"), kinds)
    for name in named:
        assert len(opened((tmp_path / name).read_bytes()).namelist()) == 1


def test_one_kind_alone_and_the_same_bytes_twice(data):
    only = opened(figures_archive(data.page_one.rows[:1], "png")).namelist()
    assert only and all(name.endswith(".png") for name in only)
    assert figures_archive(data, "svg") == figures_archive(data, "svg")
    assert opened(figures_archive({}, "svg")).namelist() == []
