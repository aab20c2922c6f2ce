"""Draw the picture of the README, page two of the reports of two shipped records: python workflow/report/example.py"""

import io
import json
from pathlib import Path

import typst
from PIL import Image

from rocking.assessment.assessor import with_histories
from rocking.assessment.scene import load_scenes
from rocking.catalogue import load_catalogue
from rocking.reports.pages import as_data
from rocking.reports.record import RecordReport
from rocking.study.job import Study, assess_catalogued, rows_of
from rocking.study.settings import Settings

ROOT = Path(__file__).parents[2]
SHOWN = "APEEL_1989", "WTMC_2016"
"""Redwood City, whose best sine leads, and Te Mara Farm, which no sine dominates."""
PIXELS_PER_INCH = 110.0


def page_two(study: Study, record: str) -> Image.Image:
    """Return page two of the report of a shipped record."""
    row = next(row for row in load_catalogue(ROOT / "records" / "catalogue.csv") if row.id == record)
    result = assess_catalogued(row, study)
    tables = rows_of(result, row, study)
    shown = with_histories(result, study.settings.tolerance)
    page = RecordReport(shown, tables, study.structures, study.settings.for_pages).page()
    reports = ROOT / "rocking" / "reports"
    data = {"data": json.dumps(as_data(page)), "families": "[]"}
    pages = typst.compile(
        reports / "record.typ", root=reports, format="png", ppi=PIXELS_PER_INCH, sys_inputs=data
    )
    return Image.open(io.BytesIO(pages[1])).convert("RGB")


def side_by_side(pictures: list[Image.Image]) -> Image.Image:
    """Return pictures of one size beside each other."""
    width, height = pictures[0].size
    both = Image.new("RGB", (width * len(pictures), height), "white")
    for place, picture in enumerate(pictures):
        both.paste(picture, (place * width, 0))
    return both


if __name__ == "__main__":
    study = Study(load_scenes(ROOT / "config" / "structures.yaml"), Settings())
    drawn = side_by_side([page_two(study, record) for record in SHOWN])
    drawn.convert("P", palette=Image.Palette.ADAPTIVE, colors=200).save(
        Path(__file__).with_suffix(".png"), optimize=True
    )
