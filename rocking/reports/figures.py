"""A document as a file, and beside it its figures as files of their own, SVG and PNG, in one archive."""

import io
import re
import zipfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Literal

import typst

from rocking.reports.printing import compile_document, document_fonts
from rocking.tables import write_whole

Figures = Literal["none", "svg", "png", "svg and png"]
_PAGE = b"""#set page(width: auto, height: auto, margin: 4pt)
#image(bytes(sys.inputs.svg), format: "svg")
"""
_PIXELS_PER_INCH = 200.0
_MADE = (2000, 1, 1, 0, 0, 0)
"""Stands in the archive as the date of each file, so that two runs of a study give the same bytes."""
_LONGEST = 60
"""Letters of the name of a file behind its number."""


def write_document(pdf: Path, template: str, data: Mapping[str, object], kinds: Figures) -> list[Path]:
    """Write the document that `template` makes of `data` and, where asked for, its figures; return the files.

    The figures of summary.pdf stand beside it in summary_figures.zip.
    """
    write_whole(pdf, compile_document(template, data))
    if kinds == "none":
        return [pdf]
    archive = pdf.with_name(f"{pdf.stem}_figures.zip")
    write_whole(archive, figures_archive(data, kinds))
    return [pdf, archive]


def figures_archive(data: object, kinds: Figures) -> bytes:
    """Return the figures in what a template is given as a ZIP archive, in the order of the report.

    Each is named by its number and what it shows: "03_scatter-of-the-rotation-ratio.svg".
    """
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for number, figure in enumerate(_figures(data), start=1):
            words = "-".join(re.findall(r"\w+", figure["alt"].lower()))[:_LONGEST].strip("-")
            name = f"{number:02d}_{words}"
            if "svg" in kinds:
                archive.writestr(zipfile.ZipInfo(f"{name}.svg", _MADE), figure["svg"])
            if "png" in kinds:
                archive.writestr(zipfile.ZipInfo(f"{name}.png", _MADE), _png(figure["svg"]))
    return content.getvalue()


def _figures(data: Any) -> Iterator[dict[str, str]]:
    """Every picture within the data, as `picture` gives it."""
    if isinstance(data, dict):
        if "svg" in data and "alt" in data:
            yield data
        for each in data.values():
            yield from _figures(each)
    elif isinstance(data, list | tuple):
        for each in data:
            yield from _figures(each)


def _png(svg: str) -> bytes:
    made = typst.compile(
        _PAGE,
        format="png",
        ppi=_PIXELS_PER_INCH,
        font_paths=document_fonts(system=False),
        ignore_system_fonts=True,
        sys_inputs={"svg": svg},
    )
    return made if isinstance(made, bytes) else made[0]
